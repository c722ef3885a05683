#include "tests/judges/margins_agreement.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "case/float_bits.h"
#include "oracle/boundary.h"
#include "oracle/classify.h"
#include "oracle/explain.h"
#include "oracle/margins.h"
#include "oracle/severity.h"
#include "tests/judges/mpq_judge.h"
#include "tests/judges/print.h"
#include "tests/judges/rational_judge.h"

namespace plumbline::judges {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// How the coordinates of a shot spread: exponents in [least, most), significands of so many bits, and perhaps a
// power of two down to 2^-tail added.
struct Spread {
  int least, most, bits, tail = 0;
};

double coordinate(std::mt19937_64& random, const Spread& spread) {
  const auto with_sign = [&random](double x) { return random() % 2 == 0 ? x : -x; };
  const auto below = [&random](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const double tail =
      spread.tail > 0 && below(2) == 0 ? with_sign(std::ldexp(1.0, -1 - below(spread.tail))) : 0;
  if (below(12) == 0) return tail;
  const int exponent = spread.least + below(spread.most - spread.least), dropped = 53 - spread.bits;
  const std::uint64_t fraction = (random() & FloatFormat<double>::fraction_mask) >> dropped << dropped;
  return with_sign(std::ldexp(1 + static_cast<double>(fraction) * 0x1p-52, exponent)) + tail;
}

Vec3 vector(std::mt19937_64& random, const Spread& spread) {
  const double x = coordinate(random, spread), y = coordinate(random, spread), z = coordinate(random, spread);
  return {x, y, z};
}

Spread draw_kind(std::mt19937_64& random, Precision precision) {
  const bool wide = precision == Precision::binary64;
  switch (random() % 4) {
    case 0:
      return {-1, 1, 2};  // few numbers: many meetings are exact
    case 1:
      return {-1, 1, 1, wide ? 51 : 22};  // nearly coinciding, nearly parallel
    default:
      return wide ? Spread{-40, 20, 53} : Spread{-30, 20, 24};
  }
}

// x is q within a relative 2^-40, or within the least subnormal of it.
void expect_value(const mpq_class& q, double x, const char* what) {
  if (std::isinf(x)) {
    ASSERT_TRUE(sgn(q) == (x > 0 ? 1 : -1) && abs(q) > mpq_class(std::numeric_limits<double>::max())) << what;
    return;
  }
  const mpq_class off = abs(mpq_class(x) - q);
  const bool near = (mpz_class(1) << 40) * off <= abs(q);
  ASSERT_TRUE(near || (q != 0 && std::abs(x) < 0x1p-1022 && off <= mpq_class(0x1p-1074)))
      << what << ' ' << x << ' ' << q.get_d();
}

// x is the root of q likewise.
void expect_root(const mpq_class& q, double x, const char* what) {
  ASSERT_GE(x, 0) << what;
  const mpq_class largest(std::numeric_limits<double>::max());
  if (std::isinf(x)) {
    ASSERT_TRUE(q > largest * largest) << what;
    return;
  }
  mpq_class slack = mpq_class(x) / (mpz_class(1) << 40);
  if (x < 0x1p-1022) slack = 0x1p-1074;
  const mpq_class low = mpq_class(x) - slack, high = mpq_class(x) + slack;
  ASSERT_TRUE((q != 0 || x == 0) && (low < 0 || low * low <= q) && q <= high * high)
      << what << ' ' << x << ' ' << std::sqrt(q.get_d());
}

void expect_near(double exact, double x, const char* what) {
  if (std::isinf(exact)) {
    ASSERT_EQ(x, exact) << what;
  } else {
    ASSERT_NO_FATAL_FAILURE(expect_value(mpq_class(exact), x, what));
  }
}

using Vec = std::array<mpq_class, 3>;
Vec difference(const Vec3& p, const Vec3& q) {
  return {mpq_class(p.x) - mpq_class(q.x), mpq_class(p.y) - mpq_class(q.y), mpq_class(p.z) - mpq_class(q.z)};
}
mpq_class square(const Vec& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }
mpq_class squared_cross(const Vec& p, const Vec& q) {
  return square({p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]});
}

void check_numbers(const Triangle& triangle, const Query& query, const Margins& m) {
  const Ray& ray = query.ray;
  const auto& [a, b, c] = triangle;
  const Determinants k = mpq_determinants(triangle, query);
  const Vec e1 = difference(b, a), e2 = difference(c, a), e3 = difference(c, b),
            tail = difference(query.direction_tail, {});
  Vec d = difference(ray.direction, {});
  for (std::size_t i = 0; i < 3; ++i) d[i] += tail[i];
  const mpq_class normal2 = squared_cross(e1, e2), det2 = k.det * k.det;
  const mpq_class longest2 = std::max<mpq_class>({square(e1), square(e2), square(e3)});
  double largest = 0;
  for (const Vec3& p : {a, b, c, ray.origin})
    for (const double x : {p.x, p.y, p.z}) largest = std::max(largest, std::abs(x));
  ASSERT_NO_FATAL_FAILURE(expect_root(det2 / square(d) / normal2, m.sine, "sine"));
  ASSERT_NO_FATAL_FAILURE(expect_root(normal2 / longest2 / longest2, m.altitude, "altitude"));
  ASSERT_NO_FATAL_FAILURE(expect_root(longest2 / mpq_class(largest) / mpq_class(largest), m.size, "size"));
  const int sign = sgn(k.det);
  ASSERT_EQ(m.ab, sgn(k.w_ab) * sign);
  ASSERT_EQ(m.bc, sgn(k.w_bc) * sign);
  ASSERT_EQ(m.ca, sgn(k.w_ca) * sign);
  if (sign == 0) {
    ASSERT_TRUE(std::isnan(m.t) && std::isnan(m.u) && std::isnan(m.v) && std::isnan(m.w));
    ASSERT_TRUE(m.t_scale == 0 && m.u_scale == 0 && m.v_scale == 0 && m.w_scale == 0);
    return;
  }
  ASSERT_NO_FATAL_FAILURE(expect_value(k.T / k.det, m.t, "t"));
  ASSERT_NO_FATAL_FAILURE(expect_value(k.w_ca / k.det, m.u, "u"));
  ASSERT_NO_FATAL_FAILURE(expect_value(k.w_ab / k.det, m.v, "v"));
  ASSERT_NO_FATAL_FAILURE(expect_value(k.w_bc / k.det, m.w, "w"));
  ASSERT_NO_FATAL_FAILURE(expect_root(det2 / normal2, m.t_scale, "t_scale"));
  ASSERT_NO_FATAL_FAILURE(expect_root(det2 / squared_cross(e2, d), m.u_scale, "u_scale"));
  ASSERT_NO_FATAL_FAILURE(expect_root(det2 / squared_cross(e1, d), m.v_scale, "v_scale"));
  ASSERT_NO_FATAL_FAILURE(expect_root(det2 / squared_cross(e3, d), m.w_scale, "w_scale"));
}

void check_severity(const Triangle& triangle, const Query& query, const Margins& m, const Severity& s,
                    bool brute_force) {
  ASSERT_NO_FATAL_FAILURE(expect_near(s.length, m.severity, "severity"));
  ASSERT_NO_FATAL_FAILURE(expect_near(s.ulps, m.severity_ulps, "severity in ulps"));
  // A subnormal length or number of ulps has too few bits to tell the unit by, and an infinite one none.
  if (s.length >= 0x1p-900 && s.ulps >= 0x1p-900 && s.ulps <= 0x1p+900)
    ASSERT_NO_FATAL_FAILURE(expect_near(s.length / s.ulps, m.ulp, "ulp"));
  if (!brute_force) return;
  const Rational s2 = squared_severity(triangle, query.ray, !m.hit);
  ASSERT_NO_FATAL_FAILURE(expect_root(mpq_class(s2.str()), m.severity, "severity by brute force"));
}

}  // namespace

Shot draw_spread(std::mt19937_64& random, Precision precision) {
  const Spread spread = draw_kind(random, precision);
  const Vec3 a = vector(random, spread), b = vector(random, spread), c = vector(random, spread);
  const Vec3 origin = vector(random, spread), direction = vector(random, spread);
  Shot shot{{a, b, c}, {origin, direction}};
  if (random() % 4 == 0) shot.ray.t_min = -inf;
  return shot;
}

Shot put_on_boundary(Shot shot, std::mt19937_64& random, Precision precision, int ulps) {
  auto& [triangle, ray] = shot;
  // Towards a point of an edge first, so that a step from the edge's line mostly decides.
  const double along = static_cast<double>(random() % 1024) * 0x1p-10;
  const Vec3 *p = &triangle.a, *q = &triangle.b;
  const auto decision = static_cast<Decision>(random() % 5);
  if (decision == Decision::bc) p = &triangle.b, q = &triangle.c;
  if (decision == Decision::ca) p = &triangle.c, q = &triangle.a;
  if (random() % 4 != 0) {
    const auto to = [&](double from, double x, double y) {
      const double target = x + along * (y - x) - from;
      return precision == Precision::binary32 ? static_cast<double>(static_cast<float>(target)) : target;
    };
    ray.direction = {to(ray.origin.x, p->x, q->x), to(ray.origin.y, p->y, q->y), to(ray.origin.z, p->z, q->z)};
  }
  const std::array<Vec3*, 5> points = {&ray.origin, &ray.direction, &triangle.a, &triangle.b, &triangle.c};
  for (int tries = 0; tries < 8; ++tries) {
    const auto k = static_cast<int>(random() % 15);
    const auto x = boundary(triangle, ray, decision, k, precision);
    if (!x || (precision == Precision::binary32 ? !is_finite(static_cast<float>(*x)) : !is_finite(*x)))
      continue;
    const int steps = static_cast<int>(random() % static_cast<unsigned>(2 * ulps + 1)) - ulps;
    Vec3& point = *points[static_cast<std::size_t>(k / 3)];
    double& moved = *std::array{&point.x, &point.y, &point.z}[static_cast<std::size_t>(k % 3)];
    moved = precision == Precision::binary32 ? static_cast<double>(step_ulps(static_cast<float>(*x), steps))
                                             : step_ulps(*x, steps);
    break;
  }
  return shot;
}

void check_margins(const Triangle& triangle, const Query& query, Precision precision, bool brute_force,
                   MarginsChecked& checked) {
  const Truth truth = classify(triangle, query);
  const auto m = margins(triangle, query, precision);
  const auto s = severity(triangle, query, !crosses(truth), precision);
  ++checked.cases;
  SCOPED_TRACE(explain(triangle, query));
  ASSERT_EQ(m.has_value(), s.has_value());
  if (!m) return;
  ++checked.measured;
  checked.hits += m->hit ? 1 : 0;
  checked.parallel += truth.hit_class == HitClass::parallel ? 1 : 0;
  ASSERT_EQ(m->truth, truth);
  ASSERT_EQ(m->hit, crosses(truth));
  ASSERT_NO_FATAL_FAILURE(check_severity(triangle, query, *m, *s, brute_force));
  ASSERT_NO_FATAL_FAILURE(check_numbers(triangle, query, *m));
}

MarginsChecked check_margins_of_family(Family family, std::uint64_t seed, std::uint64_t count) {
  const bool slow = family == Family::wide || family == Family::full_range;
  MarginsChecked checked;
  for (std::uint64_t i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << name(family) << " seed " << seed << " index " << i);
    const auto [triangle, ray] = draw(family, seed, i);
    check_margins(triangle, ray, i % 2 == 0 ? Precision::binary64 : Precision::binary32,
                  i % (slow ? 256 : 16) == 0, checked);
  }
  return checked;
}

MarginsChecked check_spread_margins(Precision precision, std::uint64_t seed, std::uint64_t count) {
  std::mt19937_64 random(seed);
  MarginsChecked checked;
  for (std::uint64_t i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "spread, " << name(precision) << " seed " << seed << " index " << i);
    Shot shot = draw_spread(random, precision);
    if (i % 4 != 0) shot = put_on_boundary(shot, random, precision, 2);
    check_margins(shot.triangle, shot.ray, precision, i % 16 == 1, checked);
  }
  return checked;
}

}  // namespace plumbline::judges
