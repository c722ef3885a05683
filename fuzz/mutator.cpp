#include "fuzz/mutator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "case/float_bits.h"
#include "case/precision.h"
#include "oracle/boundary.h"

namespace plumbline {
namespace {

Vec3 operator+(const Vec3& p, const Vec3& q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
Vec3 operator-(const Vec3& p, const Vec3& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
Vec3 operator*(double k, const Vec3& p) { return {k * p.x, k * p.y, k * p.z}; }
double dot(const Vec3& p, const Vec3& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
Vec3 cross(const Vec3& p, const Vec3& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

// One change after the other, on one input. What a move leaves outside of the domain is brought back at the end.
class Changes {
 public:
  Changes(const MutatorPlan& plan, FuzzInput& input, Random& random) : plan_(plan), x_(input), r_(random) {
    for (Vec3* p : {&x_.triangle.a, &x_.triangle.b, &x_.triangle.c}) add(*p);
    if (plan.space == Space::ray)
      for (Vec3* p : {&x_.ray.origin, &x_.ray.direction}) add(*p);
  }

  void one() {
    if (plan_.domain == Domain::full && r_.chance(8)) return any_exponent();
    if (plan_.space == Space::target) return r_.chance(3) ? aim_otherwise() : shape();
    if (r_.chance(3)) return solve();
    switch (r_.below(16)) {
      case 0: case 1: return steps();
      case 2: return copy();
      case 3: return exponent();
      case 4: case 5: case 6: return aim_at_triangle();
      case 7: return thin();
      case 8: return far();
      case 9: return grid();
      case 10: return along_edge();
      case 11: return graze();
      case 12: return new_point();
      case 13: return flip_bit();
      case 14: return slide_origin();
      default: return approach_boundary();
    }
  }

  // Mostly [0, inf]: any other range costs the oracle far more (margins.h).
  void range() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    Ray& ray = x_.ray;
    if (!r_.chance(32)) {
      ray.t_min = 0;
      ray.t_max = inf;
      return;
    }
    const Vec3 normal = cross(vertex(1) - vertex(0), vertex(2) - vertex(0));
    const double t = dot(normal, vertex(0) - ray.origin) / dot(normal, ray.direction);
    const double at_hit = stepped(at_precision(t, plan_.precision), r_.integer(-16, 16));
    const double end = is_finite(at_hit) ? at_hit : 1;
    switch (r_.below(3)) {
      case 0: ray.t_min = end; return;
      case 1: ray.t_max = end; return;
      default: ray.t_min = -inf;
    }
  }

 private:
  void add(Vec3& p) {
    for (double* c : {&p.x, &p.y, &p.z}) coordinates_[size_++] = c;
  }
  double& coordinate(std::uint64_t i) { return *coordinates_[i]; }
  double& any() { return coordinate(r_.below(size_)); }
  Vec3& vertex(std::uint64_t i) { return i == 0 ? x_.triangle.a : i == 1 ? x_.triangle.b : x_.triangle.c; }
  double power(std::int64_t low, std::int64_t high) { return std::ldexp(1.0, static_cast<int>(r_.integer(low, high))); }
  double uniform() { return std::abs(r_.unit()); }
  Vec3 units() {
    const double x = r_.unit(), y = r_.unit(), z = r_.unit();
    return {x, y, z};
  }
  bool binary32() const { return plan_.precision == Precision::binary32; }

  double stepped(double v, std::int64_t n) const {
    return step_ulps(v, n, plan_.precision);
  }
  // Mostly one ulp, else up to 2^13.
  std::int64_t few_ulps() {
    const std::int64_t n = r_.chance(3) ? 1 << r_.below(14) : 1;
    return r_.chance(2) ? n : -n;
  }

  // ---- any coordinates
  void shape() {
    switch (r_.below(10)) {
      case 0: case 1: return steps();
      case 2: return copy();
      case 3: return exponent();
      case 4: case 5: return thin();
      case 6: return far();
      case 7: return grid();
      case 8: return new_point();
      default: return flip_bit();
    }
  }
  void steps() {
    for (auto i = 1 + r_.below(4); i > 0; --i) {
      double& c = any();
      c = stepped(c, few_ulps());
    }
  }
  void copy() {
    const auto to = r_.below(size_), from = r_.chance(2) ? to % 3 + 3 * r_.below(size_ / 3) : r_.below(size_);
    coordinate(to) = coordinate(from);
    if (r_.chance(4)) coordinate(to) = -coordinate(to);
  }
  void exponent() { any() *= power(-4, 4); }
  void any_exponent() {
    const auto spread = binary32() ? 140 : 1040;
    const double k = power(-spread, spread);
    if (r_.chance(4)) {
      for (std::size_t i = 0; i < size_; ++i) coordinate(i) *= k;
    } else {
      any() *= k;
    }
  }
  void flip_bit() {
    double& c = any();
    if (binary32())
      c = from_bits<float>(to_bits(static_cast<float>(c)) ^ 1u << r_.below(23));
    else
      c = from_bits<double>(to_bits(c) ^ std::uint64_t{1} << r_.below(52));
  }
  void grid() {
    const double unit = power(-15, 4);
    const bool all = r_.chance(2);
    for (std::size_t i = 0; i < size_; ++i)
      if (all || r_.chance(5)) coordinate(i) = unit * std::nearbyint(coordinate(i) / unit);
  }
  void new_point() {
    const Vec3 point = power(-2, 2) * units();
    const auto i = r_.below(size_ / 3) * 3;
    coordinate(i) = point.x, coordinate(i + 1) = point.y, coordinate(i + 2) = point.z;
  }

  // ---- the triangle
  // A vertex onto the line of the others, or nearly: caps and needles.
  void thin() {
    const auto k = r_.below(3);
    const Vec3 &a = vertex((k + 1) % 3), &b = vertex((k + 2) % 3);
    const double along = r_.chance(4) ? 0 : 2 * r_.unit();
    vertex(k) = a + along * (b - a) + power(-29, 0) * units();
  }
  void far() {
    const double by = power(0, 19) * (1 + uniform());
    const auto axis = r_.below(4);
    const Vec3 shift = {axis % 3 == 0 ? by : 0, axis == 1 || axis == 3 ? by : 0, axis >= 2 ? by : 0};
    for (int i = 0; i < 3; ++i) vertex(i) = vertex(i) + shift;
    if (plan_.space == Space::ray) x_.ray.origin = x_.ray.origin + shift;
  }

  // ---- the ray
  Vec3 point_of_triangle() {
    std::array<double, 3> w{};
    const auto i = r_.below(3), j = (i + 1) % 3;
    switch (r_.below(4)) {
      case 0: w[i] = 1; break;
      case 1: case 2: {
        w[i] = r_.chance(2) ? uniform() : static_cast<double>(1 + r_.below(15)) / 16;
        w[j] = 1 - w[i];
        if (r_.chance(2)) {  // beside the edge
          const double beside = r_.unit() * power(-50, 0);
          w[3 - i - j] = beside;
          w[i] -= beside;
        }
        break;
      }
      default: {
        w[0] = uniform();
        w[1] = uniform() * (1 - w[0]);
        w[2] = 1 - w[0] - w[1];
      }
    }
    return w[0] * vertex(0) + w[1] * vertex(1) + w[2] * vertex(2);
  }
  void aim_at_triangle() {
    const Vec3 p = point_of_triangle();
    Ray& ray = x_.ray;
    if (r_.chance(2)) {
      ray.direction = (r_.chance(2) ? 1 : power(-3, 3)) * (p - ray.origin);
      const double length = std::sqrt(dot(ray.direction, ray.direction));
      if (r_.chance(3) && length > 0) ray.direction = 1 / length * ray.direction;
    } else {
      ray.origin = p - power(-4, 3) * (1 + uniform()) * ray.direction;
    }
  }
  void along_edge() {
    const auto i = r_.below(3);
    x_.ray.direction = vertex((i + 1) % 3) - vertex(i) + power(-50, 0) * units();
  }
  void graze() {
    const double w = r_.unit();
    x_.ray.direction = w * (vertex(1) - vertex(0)) + (1 - w) * (vertex(2) - vertex(0)) + power(-50, 0) * units();
  }
  void slide_origin() {
    const double by = power(-4, 7) * (1 + uniform());
    x_.ray.origin = x_.ray.origin + (r_.chance(2) ? by : -by) * x_.ray.direction;
  }
  // Moves the ray by nearly as much as takes its point in the plane to an edge.
  void approach_boundary() {
    const Vec3 normal = cross(vertex(1) - vertex(0), vertex(2) - vertex(0));
    const double t = dot(normal, vertex(0) - x_.ray.origin) / dot(normal, x_.ray.direction);
    if (!is_finite(t)) return;
    const auto i = r_.below(3);
    const double s = uniform(), most = 1 - r_.unit() * power(-40, 0);
    const Vec3 edge = (1 - s) * vertex(i) + s * vertex((i + 1) % 3);
    x_.ray.origin = x_.ray.origin + most * (edge - (x_.ray.origin + t * x_.ray.direction));
  }
  void solve() {
    constexpr std::array<Decision, 6> decisions = {Decision::ab,  Decision::bc,    Decision::ca,
                                                   Decision::det, Decision::t_min, Decision::t_max};
    // Mostly an edge.
    const Decision decision = r_.chance(8) ? decisions[3 + r_.below(3)] : decisions[r_.below(3)];
    const auto index = r_.below(15);
    const auto root = boundary(x_.triangle, x_.ray, decision, static_cast<int>(index));
    if (!root || !is_finite(*root)) return;
    double& c = coordinate(index < 6 ? index + 9 : index - 6);
    switch (r_.below(3)) {
      case 0: c = stepped(*root, r_.integer(-16, 16)); break;
      case 1: {  // up to half of its bits beside
        const int ulp = binary32() ? ulp_exponent(static_cast<float>(*root)) : ulp_exponent(*root);
        const double by = std::ldexp(1 + uniform(), ulp + static_cast<int>(r_.below(binary32() ? 23 : 52)));
        c = *root + (r_.chance(2) ? by : -by);
        break;
      }
      default: c = *root + (c - *root) * power(-23, 0);
    }
  }

  // ---- the target
  void aim_otherwise() {
    switch (r_.below(4)) {
      case 0: x_.target = static_cast<unsigned>(r_.below(targets_of_a_triangle)); return;
      case 1: return length(x_.standoff);
      default: return length(x_.tolerance);
    }
  }
  void length(double& l) {
    switch (r_.below(6)) {
      case 0: l = stepped(l, few_ulps()); return;
      case 1: l *= power(-4, 4); return;
      case 2: l = power(-39, 19) * (1 + uniform()); return;
      case 3: l = std::pow(10.0, static_cast<double>(r_.integer(-9, 4))); return;
      case 4: {  // in proportion to an edge
        const Vec3 edge = vertex(r_.below(2)) - vertex(2);
        l = std::sqrt(dot(edge, edge)) * (r_.chance(2) ? 1 : uniform());
        return;
      }
      default:
        if (!plan_.constants.empty())
          l = stepped(plan_.constants[r_.below(plan_.constants.size())] * (r_.chance(2) ? 1 : power(-3, 3)),
                      r_.integer(-2, 2));
    }
  }

  const MutatorPlan& plan_;
  FuzzInput& x_;
  Random& r_;
  std::array<double*, 15> coordinates_{};  // a, b, c, origin, direction
  std::size_t size_ = 0;
};

// Brings a number into the domain: one that is too small becomes 0, one that is too large keeps its fraction.
double settled(double v, Precision precision, Domain domain) {
  const bool binary32 = precision == Precision::binary32;
  if (domain == Domain::full) {
    const double most = binary32 ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
    return at_precision(is_nan(v) ? 1 : std::clamp(v, -most, most), precision);
  }
  v = at_precision(v, precision);
  if (!is_finite(v)) return 1;
  if (std::abs(v) < (binary32 ? 0x1p-30 : 0x1p-40)) return 0;
  int exponent;
  return std::abs(v) < 0x1p20 ? v : std::frexp(v, &exponent);
}

FuzzInput settled(FuzzInput x, Domain domain) {
  const auto settle = [&](double& v) { v = settled(v, x.precision, domain); };
  for (Vec3* p : {&x.triangle.a, &x.triangle.b, &x.triangle.c, &x.ray.origin, &x.ray.direction})
    settle(p->x), settle(p->y), settle(p->z);
  for (double* bound : {&x.ray.t_min, &x.ray.t_max})
    if (std::abs(*bound) != std::numeric_limits<double>::infinity()) settle(*bound);
  if (x.space == Space::ray) return x;
  for (double* length : {&x.tolerance, &x.standoff}) {
    settle(*length);
    *length = *length == 0 ? 0.125 : std::abs(*length);
  }
  if (x.target < first_target_with_tolerance) x.tolerance = 0;
  return x;
}

}  // namespace

FuzzInput Mutator::seed() const {
  FuzzInput x;
  x.space = plan_.space;
  x.precision = plan_.precision;
  x.triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  if (x.space == Space::ray)
    x.ray = {{0.25, 0.25, -3}, {0, 0, 1}};
  else
    x.standoff = 5;
  return x;
}

FuzzInput Mutator::fresh(Random& random) const {
  FuzzInput x = seed();
  const auto point = [&random] {
    const double p = 4 * random.unit(), q = 4 * random.unit(), r = 4 * random.unit();
    return Vec3{p, q, r};
  };
  for (Vec3* p : {&x.triangle.a, &x.triangle.b, &x.triangle.c}) *p = point();
  if (x.space == Space::ray)
    x.ray.origin = point(), x.ray.direction = point();
  else
    x.target = static_cast<unsigned>(random.below(targets_of_a_triangle));
  return settled(x, plan_.domain);
}

FuzzInput Mutator::changed(const FuzzInput& parent, Random& random) const {
  for (int tries = 0; tries < 8; ++tries) {
    FuzzInput x = parent;
    Changes changes(plan_, x, random);
    for (auto n = 1 + random.below(4); n > 0; --n) changes.one();
    if (plan_.space == Space::ray) changes.range();
    x = settled(x, plan_.domain);
    if (x.space == Space::target || x.ray.direction != Vec3{}) return x;
  }
  return parent;
}

}  // namespace plumbline
