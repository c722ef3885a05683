// CGAL's AABB tree as a plugin (plumbline_tracer.h): AABB_tree::first_intersection with a Ray_3 of the kernel EPICK.
//
// That tree is under the GPL, unlike the kernel, and so is the library built of this file. It is therefore built only
// when asked for (-DPLUMBLINE_CGAL_AABB=ON), a target of its own that nothing of Plumbline's links:
//
//   plumbline sweep --tracer build/release/float_tracer/gpl/libcgal_aabb_tree.so
//
// As in adapters/cgal.h: triangles and rays are closed, contact in the plane is a hit, triangles without area are
// left out, t_min and t_max are not read, and what is asked is the line through the origin and origin + direction,
// rounded. Coordinates that are not finite, and a second point that is rounded to the first, are faults. t is
// computed from the point that CGAL constructs, in doubles, as are the distances by which it orders its boxes and
// hits.
//
// Oddities: first_intersection asks the kernel's intersection(), not do_intersect(), and the two don't agree.
// - Of rays in the plane it hits some that pass the triangle by: 9 of the 3000 of `compare --family coplanar`.
// - It misses some that cross, where coordinates lie hundreds of binary orders apart: 26 of the 3000 of wide.
// cgal_epick, which asks do_intersect() the same, is wrong in none of these.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "float_tracer/plumbline_tracer.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Point point(const double* p) { return {p[0], p[1], p[2]}; }

bool all_finite(const double* p, std::size_t n) {
  return std::all_of(p, p + n, [](double x) { return std::isfinite(x); });
}

struct Bag {
  Triangles triangles;
  std::vector<std::uint32_t> indices;  // of these, in the bag that was given
  Tree tree;
};

void* prepare(const double* vertices, size_t triangles) {
  if (!all_finite(vertices, 9 * triangles)) return nullptr;
  auto* const bag = new Bag;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const double* const v = vertices + 9 * i;
    const Kernel::Triangle_3 triangle(point(v), point(v + 3), point(v + 6));
    if (triangle.is_degenerate()) continue;
    bag->triangles.push_back(triangle);
    bag->indices.push_back(i);
  }
  bag->tree.insert(bag->triangles.cbegin(), bag->triangles.cend());
  bag->tree.build();
  return bag;
}

// The second point that a Ray_3 keeps. False: there is no ray.
bool second_point(const double* origin, const double* direction, double* second) {
  if (!all_finite(origin, 3) || !all_finite(direction, 3)) return false;
  for (int i = 0; i < 3; ++i) second[i] = origin[i] + direction[i];
  return all_finite(second, 3) && !std::equal(origin, origin + 3, second);
}

void asked(void*, plumbline_query* query) {
  double second[3];
  if (!second_point(query->origin, query->direction, second)) return;
  plumbline_query held = *query;
  for (int i = 0; i < 3; ++i) {  // second - origin in two parts, exactly (Knuth)
    const double from = query->origin[i], head = second[i] - from;
    const double back = head - second[i];
    held.direction[i] = head;
    held.direction_tail[i] = (second[i] - (head - back)) - (from + back);
  }
  if (all_finite(held.direction, 3)) *query = held;
}

double parameter_of(const Point& p, const double* origin, const double* second) {
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(second[i] - origin[i]) > std::abs(second[axis] - origin[axis])) axis = i;
  return (p[axis] - origin[axis]) / (second[axis] - origin[axis]);
}

plumbline_answer answer(const Bag& bag, const plumbline_ray_f64& ray) {
  plumbline_answer said{};
  double second[3];
  if (!second_point(ray.origin, ray.direction, second)) {
    said.outcome = PLUMBLINE_FAULT;
    return said;
  }
  const auto hit = bag.tree.first_intersection(Kernel::Ray_3(point(ray.origin), point(second)));
  if (!hit) return said;
  said.outcome = PLUMBLINE_HIT;
  said.triangle = bag.indices[static_cast<std::size_t>(hit->second - bag.triangles.cbegin())];
  if (const Point* const p = boost::get<Point>(&hit->first)) {
    said.has_t = 1;
    said.t = parameter_of(*p, ray.origin, second);
  }
  return said;
}

size_t trace(void* bag, const plumbline_ray_f64* rays, size_t count, plumbline_answer* answers) {
  for (size_t i = 0; i < count; ++i) answers[i] = answer(*static_cast<const Bag*>(bag), rays[i]);
  return count;
}

void release(void* bag) { delete static_cast<Bag*>(bag); }

void describe(plumbline_description* into) {
  into->name = "cgal_aabb_tree";
  into->summary = "CGAL " CGAL_VERSION_STR ": AABB_tree::first_intersection, the ray's second point rounded";
  into->precision = 64;
  into->range = PLUMBLINE_RANGE_RAY;
  into->coplanar = PLUMBLINE_TOUCH_HIT;
  into->degenerate = PLUMBLINE_TOUCH_UNSPECIFIED;
}

}  // namespace

const plumbline_tracer_table* plumbline_tracer() {
  static const plumbline_tracer_table table = [] {
    plumbline_tracer_table t{};
    t.version = PLUMBLINE_TRACER_VERSION;
    t.describe = describe;
    t.prepare_f64 = prepare;
    t.trace_f64 = trace;
    t.asked = asked;
    t.release = release;
    return t;
  }();
  return &table;
}
