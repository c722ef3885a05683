// The textbook kernels, in both precisions, on triangles and rays where every step of each of them is exact.
#include <gtest/gtest.h>

#include "case/float_bits.h"
#include "float_tracer/kernel_tracer.h"
#include "float_tracer/moller_trumbore.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

// Twice the area is 16, a power of two: 1/det and the like don't round.
const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
// In the plane z = x + y.
const Triangle slanted{{0, 0, 0}, {4, 0, 4}, {0, 4, 4}};

Ray down(double x, double y) { return {.origin = {x, y, 8}, .direction = {0, 0, -2}}; }

class Kernel : public testing::TestWithParam<std::string> {
 protected:
  Answer shoot_at(const Triangle& triangle, const Ray& ray) {
    return shoot(GetParam(), {.triangles = {triangle}}, ray);
  }

  void expect_hit(const Triangle& triangle, const Ray& ray, double t, double u, double v) {
    const Answer answer = shoot_at(triangle, ray);
    ASSERT_EQ(answer.outcome, Outcome::hit);
    EXPECT_TRUE(answer.has_t && answer.has_uv && !answer.has_segment);
    EXPECT_EQ(answer.t, t);
    EXPECT_EQ(answer.u, u);
    EXPECT_EQ(answer.v, v);
  }

  void expect_miss(const Triangle& triangle, const Ray& ray) {
    EXPECT_EQ(shoot_at(triangle, ray).outcome, Outcome::miss);
  }

  bool single() const { return GetParam().ends_with("_f32"); }
};

INSTANTIATE_TEST_SUITE_P(All, Kernel,
                         testing::Values("moller_trumbore_f32", "moller_trumbore_f64", "woop_watertight_f32",
                                         "woop_watertight_f64", "plucker_f32", "plucker_f64", "baldwin_weber_f32",
                                         "baldwin_weber_f64"),
                         parameter_name);

TEST_P(Kernel, VerticesBelongToTheTriangle) {
  expect_hit(flat, down(0, 0), 0x1p+2, 0, 0);
  expect_hit(flat, down(4, 0), 0x1p+2, 1, 0);
  expect_hit(flat, down(0, 4), 0x1p+2, 0, 1);
}

TEST_P(Kernel, EdgesBelongToTheTriangle) {
  expect_hit(flat, down(2, 0), 0x1p+2, 0x1p-1, 0);
  expect_hit(flat, down(0, 2), 0x1p+2, 0, 0x1p-1);
  expect_hit(flat, down(2, 2), 0x1p+2, 0x1p-1, 0x1p-1);
  expect_hit(flat, down(3, 1), 0x1p+2, 0x1.8p-1, 0x1p-2);
}

TEST_P(Kernel, NothingBeyondTheEdgesBelongsToTheTriangle) {
  const double step = 0x1p-12;
  for (const double along : {0.0, 0.5, 2.0, 3.5, 4.0}) {
    expect_miss(flat, down(along, -step));
    expect_miss(flat, down(-step, along));
    expect_miss(flat, down(along + step, 4 - along));
  }
  expect_hit(flat, down(step, step), 0x1p+2, 0x1p-14, 0x1p-14);
  expect_hit(flat, down(2 - step, 2), 0x1p+2, 0x1p-1 - 0x1p-14, 0x1p-1);
}

TEST_P(Kernel, InteriorBarycentrics) {
  expect_hit(flat, down(1, 1), 0x1p+2, 0x1p-2, 0x1p-2);
  expect_hit(flat, down(0.5, 3), 0x1p+2, 0x1p-3, 0x1.8p-1);
  // Through (1, 1, 2) at t = 3; direction . normal = (1, -1, -2) . (-16, -16, 16) = -32.
  expect_hit(slanted, {.origin = {-2, 4, 8}, .direction = {1, -1, -2}}, 0x1.8p+1, 0x1p-2, 0x1p-2);
}

TEST_P(Kernel, BothSides) {
  expect_hit(flat, {.origin = {1, 2, -8}, .direction = {0, 0, 2}}, 0x1p+2, 0x1p-2, 0x1p-1);
  expect_hit(slanted, {.origin = {4, -2, -4}, .direction = {-1, 1, 2}}, 0x1.8p+1, 0x1p-2, 0x1p-2);
}

TEST_P(Kernel, RaysAlongEachAxis) {
  const auto turn = [](const Vec3& v, int by) {
    return by == 0 ? v : by == 1 ? Vec3{v.z, v.x, v.y} : Vec3{v.y, v.z, v.x};
  };
  for (int by = 0; by < 3; ++by)
    for (const double side : {1.0, -1.0}) {
      const Triangle t{turn(flat.a, by), turn(flat.b, by), turn(flat.c, by)};
      expect_hit(t, {.origin = turn({1, 2, 8 * side}, by), .direction = turn({0, 0, -2 * side}, by)}, 4, 0.25, 0.5);
    }
}

TEST_P(Kernel, WeightsFollowTheVertexOrder) {
  // The point (1, 2) has the weights a 1/4, b 1/4, c 1/2.
  const auto& [a, b, c] = flat;
  expect_hit({a, b, c}, down(1, 2), 0x1p+2, 0x1p-2, 0x1p-1);
  expect_hit({a, c, b}, down(1, 2), 0x1p+2, 0x1p-1, 0x1p-2);
  expect_hit({b, c, a}, down(1, 2), 0x1p+2, 0x1p-1, 0x1p-2);
  expect_hit({b, a, c}, down(1, 2), 0x1p+2, 0x1p-2, 0x1p-1);
  expect_hit({c, a, b}, down(1, 2), 0x1p+2, 0x1p-2, 0x1p-2);
  expect_hit({c, b, a}, down(1, 2), 0x1p+2, 0x1p-2, 0x1p-2);
}

TEST_P(Kernel, BothEndsOfTheRangeBelongToIt) {
  Ray ray = down(1, 1);
  const auto next = [this](double t, int ulps) {
    return single() ? static_cast<double>(step_ulps(static_cast<float>(t), ulps)) : step_ulps(t, ulps);
  };
  ray.t_min = ray.t_max = 4;
  expect_hit(flat, ray, 4, 0.25, 0.25);
  ray.t_min = 0, ray.t_max = next(4, -1);
  expect_miss(flat, ray);
  ray.t_min = next(4, 1), ray.t_max = infinity;
  expect_miss(flat, ray);
  ray.t_min = 5, ray.t_max = 3;
  expect_miss(flat, ray);
}

TEST_P(Kernel, StartingOnTheTriangleIsAHitAtZero) {
  expect_hit(flat, {.origin = {1, 1, 0}, .direction = {0, 0, -2}}, 0, 0.25, 0.25);
}

TEST_P(Kernel, BehindTheOriginOnlyIfTheRangeGoesThere) {
  Ray ray{.origin = {1, 1, 8}, .direction = {0, 0, 2}};
  expect_miss(flat, ray);
  ray.t_min = -4;
  expect_hit(flat, ray, -4, 0.25, 0.25);
  ray.t_min = -infinity, ray.t_max = -4;
  expect_hit(flat, ray, -4, 0.25, 0.25);
  ray.t_max = -5;
  expect_miss(flat, ray);
}

TEST_P(Kernel, NaNBoundsHoldNothing) {
  Ray ray = down(1, 1);
  ray.t_min = not_a_number;
  expect_miss(flat, ray);
  ray.t_min = 0, ray.t_max = not_a_number;
  expect_miss(flat, ray);
}

TEST_P(Kernel, NearestTriangleOfABag) {
  const Triangle upper{{0, 0, 2}, {4, 0, 2}, {0, 4, 2}};
  const Answer from_above = shoot(GetParam(), {.triangles = {flat, upper}}, down(1, 2));
  EXPECT_EQ(from_above.triangle, 1u);
  EXPECT_EQ(from_above.t, 3);
  const Answer past_upper = shoot(GetParam(), {.triangles = {flat, upper}}, {{1, 2, 1}, {0, 0, -2}});
  EXPECT_EQ(past_upper.triangle, 0u);
  EXPECT_EQ(past_upper.t, 0.5);
}

TEST_P(Kernel, TheFirstTriangleWinsATie) {
  const Triangle other{{4, 4, 0}, {0, 4, 0}, {4, 0, 0}};  // shares the slanting edge
  EXPECT_EQ(shoot(GetParam(), {.triangles = {flat, other}}, down(2, 2)).triangle, 0u);
  const Answer answer = shoot(GetParam(), {.triangles = {other, flat}}, down(1, 3));
  EXPECT_EQ(answer.triangle, 0u);
  EXPECT_EQ(answer.u, 0.75);
}

TEST_P(Kernel, AnEmptyBagIsMissed) { EXPECT_EQ(shoot(GetParam(), {}, down(1, 1)).outcome, Outcome::miss); }

// Moller and Trumbore's epsilon of 1e-6 would take this for parallel: det = 2^-40 * 2.
TEST(MollerTrumbore, HasNoEpsilon) {
  const Triangle tiny{{0, 0, 0}, {0x1p-20, 0, 0}, {0, 0x1p-20, 0}};
  const Ray ray{.origin = {0x1p-22, 0x1p-22, 8}, .direction = {0, 0, -2}};
  for (const char* name : {"moller_trumbore_f32", "moller_trumbore_f64"})
    EXPECT_EQ(shoot(name, {.triangles = {tiny}}, ray).t, 4) << name;
}

// Direction . normal is exactly 0, and the ray is off the plane; but so far from the world's origin the edges' moments
// are rounded, and all three sides come out alike.
TEST(Plucker, RejectsAParallelRayThatPassesItsEdgesOnOneSide) {
  const Triangle far{{-57388, 17063, 27235}, {-57385, 17067, 27238}, {-57395, 17071, 27240}};
  const Ray ray{.origin = {-57386, 17066, 27236}, .direction = {-3, -4, -3}};
  EXPECT_EQ(shoot("plucker_f32", {.triangles = {far}}, ray).outcome, Outcome::miss);
}

// Seen along z from the origin, edge ab passes the origin at a hair's breadth: with e = 2^-12 its edge function is
// bx ay - by ax = -(1+e)^2 + (1+2e) = -e^2, which single precision rounds to zero.
TEST(WoopWatertight, SinglePrecisionLooksAgainInDoubleWhereAnEdgeFunctionIsZero) {
  const double e = 0x1p-12;
  const Ray ray{.origin = {0, 0, -1}, .direction = {0, 0, 1}};
  const Triangle beside{{-1, -(1 + e), 0}, {1 + e, 1 + 2 * e, 0}, {4, -4, 0}};
  EXPECT_EQ(shoot("woop_watertight_f32", {.triangles = {beside}}, ray).outcome, Outcome::miss);
  const Triangle around{{-1, -(1 + e), 0}, {1 + e, 1 + 2 * e, 0}, {-4, 4, 0}};
  const Answer answer = shoot("woop_watertight_f32", {.triangles = {around}}, ray);
  EXPECT_EQ(answer.outcome, Outcome::hit);
  EXPECT_GT(answer.v, 0);
}

// The same one precision up, e = 2^-27: no wider type, so the zero stands and the near miss counts as an edge.
TEST(WoopWatertight, DoublePrecisionTakesTheZeroAsItIs) {
  const double e = 0x1p-27;
  const Triangle beside{{-1, -(1 + e), 0}, {1 + e, 1 + 2 * e, 0}, {4, -4, 0}};
  const Answer answer = shoot("woop_watertight_f64", {.triangles = {beside}}, {{0, 0, -1}, {0, 0, 1}});
  EXPECT_EQ(answer.outcome, Outcome::hit);
  EXPECT_EQ(answer.v, 0);
}

// Two triangles with opposite directions on their shared edge get opposite numbers for it: no ray falls between.
TEST(SharedEdge, WoopAndPluckerLeaveNoGap) {
  const Vec3 p{0.1f, 0.7f, 0.3f}, q{0.9f, -0.4f, 0.6f}, left{-1, -1, 0.2f}, right{2, 1.5f, -0.1f};
  for (const char* name : {"woop_watertight_f32", "woop_watertight_f64", "plucker_f32", "plucker_f64"}) {
    const auto quad = tracer_named(name).prepare({.triangles = {{p, left, q}, {p, q, right}}});
    for (int i = 1; i < 1000; ++i) {
      const float s = static_cast<float>(i) / 1000;
      const auto between = [&](double from, double to) {
        return static_cast<double>(static_cast<float>(from) * (1 - s) + static_cast<float>(to) * s);
      };
      // From (0.25, 0.25, 4) towards a point of the edge, up to rounding.
      const Ray ray = {
          .origin = {0.25, 0.25, 4},
          .direction = {between(p.x - 0.25, q.x - 0.25), between(p.y - 0.25, q.y - 0.25), between(p.z - 4, q.z - 4)}};
      Answer answer;
      quad->trace({&ray, 1}, {&answer, 1});
      EXPECT_EQ(answer.outcome, Outcome::hit) << name << " " << i;
    }
  }
}

// A kernel with a promise of its own.
template <class Real>
struct OneSided : MollerTrumbore<Real> {
  static constexpr Contract contract = {.edges = EdgeRule::open, .culling = Culling::back};
};

TEST(KernelContract, IsTheKernelsOwnIfItHasOne) {
  const KernelTracer<OneSided<float>> tracer;
  EXPECT_EQ(tracer.info().contract.edges, EdgeRule::open);
  EXPECT_EQ(tracer.info().contract.culling, Culling::back);
  EXPECT_EQ(tracer.info().contract.precision, Precision::binary32);
  EXPECT_EQ(KernelTracer<OneSided<double>>().info().contract.precision, Precision::binary64);
  EXPECT_EQ(KernelTracer<MollerTrumbore<float>>().info().contract.culling, Culling::none);
}

}  // namespace
}  // namespace plumbline
