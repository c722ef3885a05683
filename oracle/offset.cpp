#include "oracle/offset.h"

#include <algorithm>

#include "case/finite.h"
#include "oracle/dyadic.h"
#include "oracle/round.h"

namespace plumbline {
namespace {

using namespace exact;

double rounded_to(Precision precision, const Quotient& x) {
  return precision == Precision::binary32 ? rounded<float>(x) : rounded<double>(x);
}

}  // namespace

std::vector<Vec3> moved_off(const Triangle& triangle, const Vec3& point, std::span<const double> distances,
                            Precision precision) {
  const auto finite = [](double x) { return is_finite(x); };
  if (!is_finite(triangle) || !is_finite(point) || !std::ranges::all_of(distances, finite)) return {};
  const Vec a = to_exact(triangle.a), normal = cross(to_exact(triangle.b) - a, to_exact(triangle.c) - a);
  if (is_zero(normal)) return {};
  const Dyadic largest = std::max({abs(normal[0]), abs(normal[1]), abs(normal[2])});
  Vec scaled = to_exact(point);
  for (Dyadic& x : scaled) x = x * largest;
  std::vector<Vec3> moved;
  moved.reserve(distances.size());
  for (const double distance : distances) {
    const Vec there = scaled + Dyadic(distance) * normal;
    moved.push_back({rounded_to(precision, {there[0], largest}), rounded_to(precision, {there[1], largest}),
                     rounded_to(precision, {there[2], largest})});
  }
  return moved;
}

}  // namespace plumbline
