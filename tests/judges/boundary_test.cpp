// boundary against mpq: the determinants at a coordinate of 0 and 1 give the exact root; it has to be rounded
// from that, and the determinants next to it have to have different signs.
#include "oracle/boundary.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "case/float_bits.h"
#include "oracle/explain.h"
#include "tests/judges/margins_agreement.h"
#include "tests/judges/mpq_judge.h"
#include "tests/judges/print.h"
#include "tests/judges/rational_judge.h"
#include "tests/judges/seed.h"

namespace plumbline::judges {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr std::array decisions = {Decision::ab,  Decision::bc,    Decision::ca,
                                  Decision::det, Decision::t_min, Decision::t_max};

double& coordinate(Shot& s, int k) {
  const std::array<Vec3*, 5> points = {&s.ray.origin, &s.ray.direction, &s.triangle.a, &s.triangle.b,
                                       &s.triangle.c};
  Vec3& p = *points[static_cast<std::size_t>(k / 3)];
  return *std::array{&p.x, &p.y, &p.z}[static_cast<std::size_t>(k % 3)];
}

// The determinant with that coordinate at x; the bound of t, where it counts, is finite.
mpq_class value(Shot shot, Decision decision, int k, double x) {
  coordinate(shot, k) = x;
  const Determinants d = mpq_determinants(shot.triangle, shot.ray);
  switch (decision) {
    case Decision::ab:
      return d.w_ab;
    case Decision::bc:
      return d.w_bc;
    case Decision::ca:
      return d.w_ca;
    case Decision::det:
      return d.det;
    case Decision::t_min:
      return d.T - mpq_class(shot.ray.t_min) * d.det;
    case Decision::t_max:
      return d.T - mpq_class(shot.ray.t_max) * d.det;
  }
  return 0;
}

// Whether there is a root, and none is not there by mistake.
template <class Real>
bool check_root(const Shot& shot, Decision decision, int k) {
  constexpr Precision precision = std::is_same_v<Real, float> ? Precision::binary32 : Precision::binary64;
  const auto x = boundary(shot.triangle, shot.ray, decision, k, precision);
  const mpq_class at_0 = value(shot, decision, k, 0), slope = value(shot, decision, k, 1) - at_0;
  if (slope == 0) {
    EXPECT_FALSE(x.has_value());
    return false;
  }
  const mpq_class root = -at_0 / slope;
  const Rational exact(root.get_str());
  if (!x) {
    EXPECT_TRUE(is_rounded<Real>(
        exact, root > 0 ? std::numeric_limits<Real>::infinity() : -std::numeric_limits<Real>::infinity()));
    return false;
  }
  const auto real = static_cast<Real>(*x);
  EXPECT_EQ(static_cast<double>(real), *x);
  EXPECT_TRUE(is_rounded<Real>(exact, real)) << *x;
  const double below = static_cast<double>(step_ulps(real, -1)),
               above = static_cast<double>(step_ulps(real, 1));
  const int here = sgn(value(shot, decision, k, *x));
  EXPECT_EQ(here == 0, mpq_class(*x) == root);
  if (std::isfinite(below) && std::isfinite(above)) {
    EXPECT_EQ(sgn(value(shot, decision, k, below)), -sgn(slope));
    EXPECT_EQ(sgn(value(shot, decision, k, above)), sgn(slope));
  }
  return true;
}

// Every decision that has a bound, every coordinate, both precisions.
int check_all(const Shot& shot) {
  int roots = 0;
  for (const Decision decision : decisions)
    for (int k = 0; k < 15; ++k) {
      SCOPED_TRACE(testing::Message() << "decision " << static_cast<int>(decision) << " coordinate " << k
                                      << '\n'
                                      << explain(shot.triangle, shot.ray));
      const double tau = decision == Decision::t_min ? shot.ray.t_min : shot.ray.t_max;
      if (decision >= Decision::t_min && !is_finite(tau)) {
        EXPECT_FALSE(boundary(shot.triangle, shot.ray, decision, k));
        continue;
      }
      roots += check_root<double>(shot, decision, k) ? 1 : 0;
      roots += check_root<float>(shot, decision, k) ? 1 : 0;
      if (testing::Test::HasFailure()) return roots;
    }
  return roots;
}

class BoundaryOf : public testing::TestWithParam<std::size_t> {};

TEST_P(BoundaryOf, IsTheRoundedRootOfEveryDecisionInEveryCoordinate) {
  const auto family = static_cast<Family>(GetParam());
  const int count = family == Family::wide || family == Family::full_range ? 20 : 30;
  int roots = 0;
  for (int i = 0; i < count && !HasFailure(); ++i)
    roots += check_all(draw(family, seed() + 7, static_cast<std::uint64_t>(i)));
  std::printf("%s, seed %llu: %d roots\n", name(family).data(), static_cast<unsigned long long>(seed()), roots);
  EXPECT_GT(roots, family == Family::degenerate ? 300 : 900);
}

INSTANTIATE_TEST_SUITE_P(Families, BoundaryOf, testing::Range<std::size_t>(0, family_names.size()),
                         [](const auto& each) { return std::string(family_names[each.param]); });

TEST(Boundary, OfSpreadCasesIsTheRoundedRoot) {
  std::mt19937_64 random(seed() + 8);
  int roots = 0;
  for (int i = 0; i < 100 && !HasFailure(); ++i) {
    Shot shot = draw_spread(random, Precision::binary64);
    const std::array bounds = {0.0, 1.0, -0x1.8p-3, 0x1p-1074, 0x1.fffffffffffffp+1023};
    shot.ray.t_max = bounds[random() % bounds.size()];
    roots += check_all(shot);
  }
  std::printf("seed %llu: %d roots\n", static_cast<unsigned long long>(seed()), roots);
  EXPECT_GT(roots, 10000);
}

// In the plane z = height: T - tau det = (height - o.z - tau d.z) * 4.
Triangle level(double height) { return {{-1, -1, height}, {1, -1, height}, {-1, 1, height}}; }

TEST(Boundary, OfATieIsEven) {
  // b.x on the line through A = (0, -1) and the origin, seen along z: w_AB = -(x_A y_B - x_B y_A).
  const auto x_of_b = [](double a_x, double a_y, double b_y, Precision precision) {
    const Triangle t{{a_x, a_y, 0}, {7, b_y, 0}, {1, 1, 0}};
    return *boundary(t, Ray{{0, 0, 1}, {0, 0, -1}}, Decision::ab, 9, precision);
  };
  // a.x * 3/2 has 54 bits; its last one is halfway.
  EXPECT_EQ(x_of_b(0x1.0000000000001p+0, 2, 3, Precision::binary64), 0x1.8000000000002p+0);  // ..01.1
  EXPECT_EQ(x_of_b(0x1.0000000000003p+0, 2, 3, Precision::binary64), 0x1.8000000000004p+0);  // ..04.1
  EXPECT_EQ(x_of_b(0x1.000002p+0, 2, 3, Precision::binary32), 0x1.800004p+0);
  EXPECT_EQ(x_of_b(0x1.000006p+0, 2, 3, Precision::binary32), 0x1.800008p+0);
  // A binary32 tie that binary64 would make: 1 + 2^-24 + 2^-60 is above it.
  EXPECT_EQ(*boundary(level(0x1.000001p+0), Ray{{0, 0, 5}, {0, 0, 1}, 0x1p-60}, Decision::t_min, 2,
                      Precision::binary32),
            0x1p+0);
  EXPECT_EQ(*boundary(level(0x1.000001p+0), Ray{{0, 0, 5}, {0, 0, 1}, -0x1p-60}, Decision::t_min, 2,
                      Precision::binary32),
            0x1.000002p+0);
}

TEST(Boundary, ByHand) {
  const Triangle t{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const Ray ray{{1, 1, 2}, {0, 0, -1}, 0, 8};
  EXPECT_EQ(boundary(t, ray, Decision::ab, 1), 0.0);  // origin.y onto AB
  EXPECT_EQ(boundary(t, ray, Decision::bc, 0), 3.0);  // origin.x onto BC: x + y = 4
  EXPECT_EQ(boundary(t, ray, Decision::ca, 0), 0.0);
  EXPECT_EQ(boundary(t, ray, Decision::bc, 3), 1.0);                   // direction.x: 1 + 2 dx = 3
  EXPECT_EQ(boundary(t, ray, Decision::det, 5), 0.0);                  // direction.z: into the plane
  EXPECT_EQ(boundary(t, ray, Decision::t_min, 2), 0.0);                // origin.z into the plane
  EXPECT_EQ(boundary(t, ray, Decision::t_max, 2), 8.0);                // origin.z: the ray ends in the plane
  EXPECT_EQ(boundary(t, ray, Decision::t_max, 5), -0x1p-2);            // direction.z: 2 + 8 dz = 0
  EXPECT_EQ(boundary(t, ray, Decision::bc, 9), 0x1.5555555555555p+0);  // b.x: 1 / b.x + 1 / 4 = 1
}

TEST(Boundary, NoneWhereTheDeterminantDoesNotDependOnTheCoordinate) {
  const Triangle t{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const Ray ray{{1, 1, 2}, {0, 0, -1}};
  for (int k = 12; k < 15; ++k) EXPECT_FALSE(boundary(t, ray, Decision::ab, k));   // C is not on AB
  for (int k = 0; k < 3; ++k) EXPECT_FALSE(boundary(t, ray, Decision::det, k));    // nor the origin in det
  for (int k = 3; k < 6; ++k) EXPECT_FALSE(boundary(t, ray, Decision::t_min, k));  // nor the direction in T
  EXPECT_FALSE(boundary(t, ray, Decision::ab, 0));                                 // along AB
}

TEST(Boundary, NoneWithoutAFiniteCase) {
  const Triangle t{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(boundary(t, Ray{{1, 1, 2}, {0, 0, -1}, -inf, inf}, Decision::ab, 1));
  EXPECT_FALSE(boundary(t, Ray{{1, 1, 2}, {0, 0, -1}, -inf, inf}, Decision::t_min, 2));
  EXPECT_FALSE(boundary(t, Ray{{1, 1, 2}, {0, 0, -1}, -inf, inf}, Decision::t_max, 2));
  EXPECT_FALSE(boundary(t, Ray{{1, 1, 2}, {0, 0, -1}, nan, inf}, Decision::t_min, 2));
  EXPECT_FALSE(boundary(t, Ray{{1, inf, 2}, {0, 0, -1}}, Decision::ab, 1));
  EXPECT_FALSE(boundary(t, Ray{{1, 1, 2}, {0, nan, -1}}, Decision::ab, 1));
  EXPECT_FALSE(boundary({{0, 0, 0}, {4, 0, 0}, {0, 4, -inf}}, Ray{{1, 1, 2}, {0, 0, -1}}, Decision::ab, 1));
}

TEST(Boundary, NoneWhereTheValueOverflows) {
  // direction.z = (height - 0) / tau.
  const auto z = [](double height, double tau, Precision precision) {
    return boundary(level(height), Ray{{0, 0, 0}, {0, 0, 1}, tau}, Decision::t_min, 5, precision);
  };
  EXPECT_EQ(z(0x1.fffffffffffffp+1023, 1, Precision::binary64), 0x1.fffffffffffffp+1023);
  EXPECT_FALSE(z(0x1p+1023, 0x1p-1, Precision::binary64));
  EXPECT_EQ(z(0x1.fffffefffffffp+127, 1, Precision::binary32), 0x1.fffffep+127);
  EXPECT_FALSE(z(0x1.ffffffp+127, 1, Precision::binary32));
  EXPECT_EQ(z(0x1p-1074, 2, Precision::binary64), 0.0);
  EXPECT_EQ(z(0x1.8p-1073, 2, Precision::binary64), 0x1p-1073);
  EXPECT_EQ(z(0x1.8p-150, 1, Precision::binary32), 0x1p-149);
}

}  // namespace
}  // namespace plumbline::judges
