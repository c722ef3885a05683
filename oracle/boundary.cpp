#include "oracle/boundary.h"

#include <array>
#include <cstddef>

#include "case/finite.h"
#include "oracle/dyadic.h"
#include "oracle/quotient.h"
#include "oracle/round.h"
#include "oracle/wide_case.h"

namespace plumbline {
namespace {

// Origin, direction, a, b, c, as vectors of one kind of number or another.
template <class Vec>
using Points = std::array<Vec, 5>;

template <class Vec>
auto determinant(const Points<Vec>& points, Decision decision) {
  const auto& [origin, direction, a, b, c] = points;
  switch (decision) {
    case Decision::ab: return dot(direction, cross(a - origin, b - origin));
    case Decision::bc: return dot(direction, cross(b - origin, c - origin));
    case Decision::ca: return dot(direction, cross(c - origin, a - origin));
    case Decision::det: return dot(direction, cross(b - a, c - a));
    case Decision::t_min:
    case Decision::t_max: break;
  }
  return dot(a - origin, cross(b - a, c - a));  // T
}

// Of a determinant p + q x given by its values at x = 0 and x = 1: -p and q.
template <class Number>
struct Root {
  Number numerator, denominator;
  Root(const Number& at_0, const Number& at_1) : numerator(-at_0), denominator(at_1 - at_0) {}
};

template <class Real>
[[gnu::noinline]] std::optional<Real> root_any(const Triangle& triangle, const Ray& ray, Decision decision,
                                               double tau, std::size_t coordinate) {
  using namespace exact;
  const auto value_at = [&](double x) {
    Points<Vec> points = {to_exact(ray.origin), to_exact(ray.direction), to_exact(triangle.a),
                          to_exact(triangle.b), to_exact(triangle.c)};
    points[coordinate / 3][coordinate % 3] = Dyadic(x);
    const Dyadic value = determinant(points, decision);
    return is_zero(tau) ? value : value - Dyadic(tau) * determinant(points, Decision::det);
  };
  const Root<Dyadic> root(value_at(0), value_at(1));
  if (root.denominator.sign() == 0) return std::nullopt;
  return rounded<Real>(Quotient(root.numerator, root.denominator));
}

double& at(Triangle& triangle, Ray& ray, std::size_t coordinate) {
  Vec3& point = *std::array{&ray.origin, &ray.direction, &triangle.a, &triangle.b, &triangle.c}[coordinate / 3];
  return *std::array{&point.x, &point.y, &point.z}[coordinate % 3];
}

// tau: 0 but for a bound of t.
template <class Real>
std::optional<Real> root(Triangle triangle, Ray ray, Decision decision, double tau, std::size_t coordinate) {
  at(triangle, ray, coordinate) = 0;
  const auto grid = is_zero(tau) ? WideCase::make(triangle, ray) : std::nullopt;
  if (!grid) return root_any<Real>(triangle, ray, decision, tau, coordinate);
  const auto value_at = [&](Int128 x) {
    Points<WideVec<2>> points = {grid->origin, grid->direction, grid->a, grid->b, grid->c};
    points[coordinate / 3][coordinate % 3] = WideInt<2>(x);
    return determinant(points, decision);
  };
  const Root<WideInt<6>> root(value_at(0), value_at(1));
  if (root.denominator.sign() == 0) return std::nullopt;
  const auto quotient = rounded_quotient<Real>(root.numerator, root.denominator,
                                               coordinate / 3 == 1 ? grid->direction_unit : grid->point_unit);
  return quotient ? quotient : root_any<Real>(triangle, ray, decision, tau, coordinate);
}

// Exact, under DAZ too, where a conversion takes subnormals for zeros.
double widened(float x) {
  const bool subnormal = !is_zero(x) && (to_bits(x) & FloatFormat<float>::exponent_mask) == 0;
  return subnormal ? static_cast<double>(ordinal(x)) * 0x1p-149 : static_cast<double>(x);
}

}  // namespace

std::optional<double> boundary(const Triangle& triangle, const Ray& ray, Decision decision, int coordinate,
                               Precision precision) {
  if (!is_finite(triangle) || !is_finite(ray.origin) || !is_finite(ray.direction)) return std::nullopt;
  const double tau = decision == Decision::t_min ? ray.t_min : decision == Decision::t_max ? ray.t_max : 0;
  if (!is_finite(tau)) return std::nullopt;
  const auto k = static_cast<std::size_t>(coordinate);
  std::optional<double> x;
  if (precision == Precision::binary64) {
    x = root<double>(triangle, ray, decision, tau, k);
  } else if (const auto single = root<float>(triangle, ray, decision, tau, k)) {
    x = widened(*single);
  }
  return x && is_finite(*x) ? x : std::nullopt;
}

}  // namespace plumbline
