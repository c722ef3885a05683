#include "tests/oracle/filter_search.h"

#include <cmath>
#include <limits>

#include "case/float_bits.h"
#include "tests/oracle/filter_values.h"

namespace plumbline {
namespace {

__extension__ using Quad = __float128;

// So that binary128 stays exact enough.
constexpr double least_coordinate = 0x1p-30, largest_coordinate = 2;

struct QuadVec {
  Quad x, y, z;
};
QuadVec operator-(const Vec3& p, const Vec3& q) { return {Quad{p.x} - q.x, Quad{p.y} - q.y, Quad{p.z} - q.z}; }
QuadVec cross(const QuadVec& p, const QuadVec& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
Quad dot(const QuadVec& p, const QuadVec& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }

struct Exact {
  Quad det, T, w_ab, w_bc, w_ca, V;
  explicit Exact(const Shot& s) {
    const auto& [t, r] = s;
    const QuadVec a = t.a - r.origin, e1 = t.b - t.a, e2 = t.c - t.a, d = r.direction - Vec3{}, n = cross(e1, e2),
                  h = cross(d, a);
    det = dot(d, n);
    T = dot(a, n);
    w_ab = dot(e1, h);
    w_ca = -dot(e2, h);
    w_bc = det - w_ca - w_ab;
    V = T - r.t_min * det;
  }
};

Quad exact_value(const Exact& y, Measured measured) {
  switch (measured) {
    case Measured::det:
      return y.det;
    case Measured::T:
      return y.T;
    case Measured::w_ab:
      return y.w_ab;
    case Measured::w_bc:
      return y.w_bc;
    case Measured::w_ca:
      return y.w_ca;
    case Measured::V:
    case Measured::V_alone:
      return y.V;
  }
  return 0;
}

struct Measure {
  double computed, bound;
};

Measure measure(const FilterValues& x, Measured measured) {
  switch (measured) {
    case Measured::det:
      return {x.det, x.det_bound};
    case Measured::T:
      return {x.T, x.T_bound};
    case Measured::w_ab:
      return {x.w_ab, x.w_bound};
    case Measured::w_bc:
      return {x.w_bc, x.w_bc_bound};
    case Measured::w_ca:
      return {x.w_ca, x.w_bound};
    case Measured::V:
      return {x.V, x.V_bound};
    case Measured::V_alone:
      return {x.V, x.T_bound};
  }
  return {};
}

// Whether the filter's decision hangs on the measured value alone.
bool otherwise_certain(const FilterValues& x, Measured measured) {
  if (measured == Measured::det)
    return std::fabs(x.w_ab) > x.w_bound && std::fabs(x.w_ca) > x.w_bound && std::fabs(x.w_bc) > x.w_bc_bound;
  const double s = std::copysign(1.0, x.det);
  return std::fabs(x.det) > x.det_bound && (measured == Measured::w_ab || s * x.w_ab > x.w_bound) &&
         (measured == Measured::w_ca || s * x.w_ca > x.w_bound) &&
         (measured == Measured::w_bc || s * x.w_bc > x.w_bc_bound);
}

Vec3 mix(const Vec3& p, double k, const Vec3& q, double l) {
  return {k * p.x + l * q.x, k * p.y + l * q.y, k * p.z + l * q.z};
}

double unit(Random& random) {
  return static_cast<double>(uniform(random, -(1ll << 53) + 1, (1ll << 53) - 1)) * 0x1p-53;
}

// A start at which the measured value is nearly zero.
Shot start(Measured measured, Random& random) {
  const auto vec = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
  const auto part = [&] { return std::fabs(unit(random)); };
  Shot s{{vec(), vec(), vec()}, {vec(), {}}};
  const auto& [a, b, c] = s.triangle;
  const double k = part();
  Vec3 target = mix(mix(a, k, b, 1 - k), part(), c, 0);
  switch (measured) {
    case Measured::det:
      s.ray.direction = mix(mix(b, 1, a, -1), unit(random), mix(c, 1, a, -1), unit(random));
      return s;
    case Measured::w_ab:
      target = mix(a, k, b, 1 - k);
      break;
    case Measured::w_bc:
      target = mix(b, k, c, 1 - k);
      break;
    case Measured::w_ca:
      target = mix(c, k, a, 1 - k);
      break;
    case Measured::T:
    case Measured::V:
    case Measured::V_alone: {
      const double l = part();
      target = mix(mix(a, k, b, 1 - k), l, c, 1 - l);
      break;
    }
  }
  if (measured == Measured::T) {
    s.ray.origin = target;
    s.ray.direction = vec();
    s.ray.t_min = 0;
    return s;
  }
  s.ray.direction = mix(target, 1, s.ray.origin, -1);
  s.ray.t_min = measured == Measured::V || measured == Measured::V_alone ? 1 : -std::numeric_limits<double>::infinity();
  return s;
}

std::array<double*, 15> coordinates(Shot& s) {
  auto& [t, r] = s;
  return {&t.a.x, &t.a.y,      &t.a.z,      &t.b.x,      &t.b.y,         &t.b.z,         &t.c.x,        &t.c.y,
          &t.c.z, &r.origin.x, &r.origin.y, &r.origin.z, &r.direction.x, &r.direction.y, &r.direction.z};
}

void change(double& x, Random& random) {
  double y = x;
  switch (random() % 4) {
    case 0:
      y = step_ulps(x, uniform(random, -2, 2));
      break;
    case 1:
      y = step_ulps(x, (random() % 2 == 0 ? 1 : -1) * (std::int64_t{1} << random() % 52));
      break;
    case 2:
      y = x + std::ldexp(unit(random), -static_cast<int>(random() % 50));
      break;
    default:
      y = unit(random) * (random() % 4 == 0 ? 0.25 : 1);
  }
  if (std::fabs(y) > least_coordinate && std::fabs(y) < largest_coordinate) x = y;
}

// Every determinant is linear in each coordinate: moves one of them to where the exact value is zero, but for rounding.
void make_zero(Shot& shot, Measured measured, double& x) {
  const double before = x;
  const Quad value = exact_value(Exact(shot), measured);
  x = before + 1;
  const Quad slope = (exact_value(Exact(shot), measured) - value) / (Quad{x} - before);
  const double zero = static_cast<double>(before - value / slope);
  x = std::fabs(zero) > least_coordinate && std::fabs(zero) < largest_coordinate ? zero : before;
}

}  // namespace

double ratio(const Shot& shot, Measured measured, Objective objective, const FloatEnvironment& environment) {
  FilterValues x;
  {
    const FloatScope scope(environment);
    x = filter_values(shot);
  }
  const auto [computed, bound] = measure(x, measured);
  const Quad exact = exact_value(Exact(shot), measured);
  if (objective == Objective::error)
    return static_cast<double>((computed > exact ? computed - exact : exact - computed) / bound);
  if (!otherwise_certain(x, measured)) return -std::numeric_limits<double>::infinity();
  const bool wrong = computed > 0 ? exact <= 0 : exact >= 0;
  return (wrong ? 1 : -1) * std::fabs(computed) / bound;
}

Worst climb(Measured measured, Objective objective, const FloatEnvironment& environment, Random& random,
            int evaluations) {
  constexpr int patience = 4000;
  Worst best;
  while (evaluations > 0) {
    Worst here{.shot = start(measured, random)};
    here.ratio = ratio(here.shot, measured, objective, environment);
    for (int idle = 0; idle < patience && evaluations > 0; ++idle, --evaluations) {
      Shot next = here.shot;
      const auto all = coordinates(next);
      for (int n = 1 + static_cast<int>(random() % 3); n > 0; --n) change(*all[random() % all.size()], random);
      if (objective == Objective::wrong_side) {
        double& x = *all[random() % all.size()];
        make_zero(next, measured, x);
        x = step_ulps(x, uniform(random, -1, 1));
      }
      const double r = ratio(next, measured, objective, environment);
      if (!(r >= here.ratio)) continue;
      if (r > here.ratio) idle = 0;
      here = {r, next};
    }
    if (here.ratio > best.ratio) best = here;
  }
  return best;
}

}  // namespace plumbline
