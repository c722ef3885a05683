// Other ways to ask the same question, for comparison: GMP's rationals, and CGAL's and Boost's arithmetic where the
// build has them. None of this is linked into the oracle.
#pragma once
#include <string_view>
#include <vector>

#include "analysis/bench/answers.h"
#include "case/geometry.h"

namespace plumbline {

/// All coordinates are finite, and no bound of the range is a NaN.
struct Rival {
  std::string_view name;
  Answers answers = Answers::truth;
  bool exact = true;
  bool needs_area = false;  ///< asked only where the direction is not zero and the triangle has area; t_min is 0
  Truth (*ask)(const Triangle&, const Ray&) = nullptr;
};

std::vector<Rival> rivals();

/// The direct formula in mpq_class: the judge of every method's answers.
Truth ask_mpq(const Triangle& triangle, const Ray& ray);

// Only where the build has the library.
Truth ask_cpp_rational(const Triangle& triangle, const Ray& ray);
Truth ask_epick_orientations(const Triangle& triangle, const Ray& ray);
Truth ask_epeck_do_intersect(const Triangle& triangle, const Ray& ray);
Truth ask_epeck_ft(const Triangle& triangle, const Ray& ray);

}  // namespace plumbline
