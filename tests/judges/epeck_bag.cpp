#include "tests/judges/epeck_bag.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace plumbline::judges {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;

struct Interval {
  Number low, high;
};

// Of what a line has in common with a triangle, or with what is left of one without area.
template <class Target>
std::optional<Interval> common(const Point& o, const Vector& d, const Target& target) {
  const auto met = CGAL::intersection(Kernel::Line_3(o, d), target);
  if (!met) return std::nullopt;
  const auto at = [&](const Point& p) { return CGAL::scalar_product(p - o, d) / d.squared_length(); };
  if (const Point* p = boost::get<Point>(&*met)) return Interval{at(*p), at(*p)};
  const Kernel::Segment_3* s = boost::get<Kernel::Segment_3>(&*met);
  const Number first = at(s->source()), last = at(s->target());
  return Interval{std::min(first, last), std::max(first, last)};
}

std::optional<Interval> common(const Point& o, const Vector& d, const Point& a, const Point& b, const Point& c) {
  if (!CGAL::collinear(a, b, c)) return common(o, d, Kernel::Triangle_3(a, b, c));
  if (a == b && b == c) {
    if (!Kernel::Line_3(o, d).has_on(a)) return std::nullopt;
    const Number t = CGAL::scalar_product(a - o, d) / d.squared_length();
    return Interval{t, t};
  }
  const Kernel::Segment_3 sides[] = {{a, b}, {b, c}, {c, a}};
  return common(o, d, *std::max_element(std::begin(sides), std::end(sides), [](const auto& x, const auto& y) {
                  return x.squared_length() < y.squared_length();
                }));
}

}  // namespace

EpeckBag epeck_bag(std::span<const Triangle> triangles, const Ray& ray) {
  const auto point = [](const Vec3& v) { return Point(v.x, v.y, v.z); };
  const Point o = point(ray.origin);
  const Vector d(ray.direction.x, ray.direction.y, ray.direction.z);
  struct At {
    Number t;
    std::uint32_t triangle;
  };
  std::vector<At> crossed;
  EpeckBag bag;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Point a = point(triangles[i].a), b = point(triangles[i].b), c = point(triangles[i].c);
    auto met = common(o, d, a, b, c);
    if (!met) continue;
    if (std::isfinite(ray.t_min) ? met->high < Number(ray.t_min) : ray.t_min > 0) continue;
    if (std::isfinite(ray.t_max) ? met->low > Number(ray.t_max) : ray.t_max < 0) continue;
    if (ray.t_min > ray.t_max) continue;
    if (CGAL::collinear(a, b, c) || CGAL::coplanar(a, b, c, a + d))
      bag.stretches.push_back(i);
    else
      crossed.push_back({met->low, i});
  }
  std::sort(crossed.begin(), crossed.end(),
            [](const At& x, const At& y) { return x.t != y.t ? x.t < y.t : x.triangle < y.triangle; });
  for (std::size_t i = 0; i < crossed.size(); ++i) {
    const std::uint32_t rank = i == 0 ? 0 : bag.hits.back().rank + (crossed[i].t != crossed[i - 1].t ? 1 : 0);
    bag.hits.push_back({crossed[i].triangle, rank});
  }
  return bag;
}

}  // namespace plumbline::judges
