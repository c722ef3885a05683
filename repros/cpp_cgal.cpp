// As float_tracer/adapters/cgal.cpp asks.
#include "repros/c_check.h"
#include "repros/forms.h"
#include "repros/text.h"

namespace plumbline {
namespace {

constexpr std::string_view command =
    "g++ -std=c++17 -O2 -frounding-math repro.cpp -lmpfr -lgmp -o repro && ./repro      # libcgal-dev";

constexpr std::string_view text = R"(@STORY@
#include <@HEADER@>
#include <CGAL/Intersections_3/Ray_3_Triangle_3.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

using Kernel = CGAL::@KERNEL@;

@CASE@
@ANSWER@
static Kernel::Point_3 point(const double* v) { return Kernel::Point_3(v[0], v[1], v[2]); }

static Answer ask() {
  const Kernel::Triangle_3 triangle(point(a), point(b), point(c));
  if (triangle.is_degenerate()) return {};  // against the precondition of do_intersect
  // From t = 0 on: a Ray_3 has no other range.
  const Kernel::Ray_3 ray(point(origin), Kernel::Vector_3(direction[0], direction[1], direction[2]));
  return {CGAL::do_intersect(ray, triangle), 0, 0, 0};
}

@MAIN@)";

struct Kernel {
  std::string_view tracer, header, name;
};

constexpr Kernel kernels[] = {{"cgal_cartesian_f64", "CGAL/Simple_cartesian.h", "Simple_cartesian<double>"},
                              {"cgal_epick", "CGAL/Exact_predicates_inexact_constructions_kernel.h",
                               "Exact_predicates_inexact_constructions_kernel"},
                              {"cgal_epeck", "CGAL/Exact_predicates_exact_constructions_kernel.h",
                               "Exact_predicates_exact_constructions_kernel"}};

const Kernel& kernel_of(std::string_view tracer) {
  for (const Kernel& kernel : kernels)
    if (kernel.tracer == tracer) return kernel;
  return kernels[0];
}

}  // namespace

std::string cpp_cgal(const Case& what, std::string_view tracer) {
  const Evidence e = gather_to_ask(what, tracer);
  constexpr std::string_view type = "static const double";
  const Kernel& kernel = kernel_of(tracer);
  return fill(text, {{"STORY", commented(story(e, command), "// ")},
                     {"HEADER", std::string(kernel.header)},
                     {"KERNEL", std::string(kernel.name)},
                     {"CASE", c_triangle(e, type) + c_ray(e, type)},
                     {"ANSWER", c_answer()},
                     {"MAIN", c_main(e, {})}});
}

}  // namespace plumbline
