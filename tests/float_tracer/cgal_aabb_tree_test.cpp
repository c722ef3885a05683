// The plugin of CGAL's AABB tree, where it is built.
#include <gtest/gtest.h>

#include <limits>

#include "float_tracer/plugin.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

const Triangle unit = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const Triangle above = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
const Triangle flat = {{0, 0, 3}, {1, 0, 3}, {2, 0, 3}};

class CgalAabbTree : public testing::Test {
 protected:
  Answer shoot_at(const std::vector<Triangle>& triangles, const Ray& ray) {
    return shoot(*tracer_, {.triangles = triangles}, ray);
  }
  Outcome outcome(const Ray& ray) { return shoot_at({unit}, ray).outcome; }

  std::unique_ptr<Tracer> tracer_ = load_plugin(PLUMBLINE_CGAL_AABB_TREE);
};

TEST_F(CgalAabbTree, HitsBothSidesAndTheWholeBoundary) {
  for (const double z : {2.0, -2.0}) {
    EXPECT_EQ(outcome({{0.25, 0.25, z}, {0, 0, -z}}), Outcome::hit);
    EXPECT_EQ(outcome({{0.5, 0.5, z}, {0, 0, -z}}), Outcome::hit);
    EXPECT_EQ(outcome({{0, 0, z}, {0, 0, -z}}), Outcome::hit);
    EXPECT_EQ(outcome({{0.5, 0x1.0000000000001p-1, z}, {0, 0, -z}}), Outcome::miss);
    EXPECT_EQ(outcome({{0.25, 0.25, z}, {0, 0, z}}), Outcome::miss);
  }
  EXPECT_EQ(outcome({{0.25, 0.25, 0}, {0, 0, 1}}), Outcome::hit);   // t = 0
  EXPECT_EQ(outcome({{-1, 0.25, 0}, {1, 0, 0}}), Outcome::hit);     // in the plane
  EXPECT_EQ(outcome({{-1, 0.25, 0}, {-1, 0, 0}}), Outcome::miss);
  EXPECT_EQ(outcome({{-1, 0.25, 1}, {1, 0, 0}}), Outcome::miss);    // parallel
}

TEST_F(CgalAabbTree, NamesTheNearestOfABag) {
  const Ray down = {{0.25, 0.5, 2}, {0, 0, -0.5}};
  const Answer hit = shoot_at({unit, flat, above, unit}, down);
  EXPECT_EQ(hit.outcome, Outcome::hit);
  EXPECT_EQ(hit.triangle, 2u);
  ASSERT_TRUE(hit.has_t);
  EXPECT_EQ(hit.t, 0x1p+1);
  EXPECT_EQ(shoot_at({flat}, down).outcome, Outcome::miss);
  EXPECT_EQ(shoot_at({}, down).outcome, Outcome::miss);
}

TEST_F(CgalAabbTree, IsAskedTheLineThroughTwoRoundedPoints) {
  EXPECT_TRUE(tracer_->info().own_queries);
  const auto bag = tracer_->prepare({.triangles = {unit}});
  const Ray ray = {{0x1p+0, 0, 0x1p-60}, {0x1.8p-53, 0, -0x1p+0}};
  Answer answer;
  bag->trace({&ray, 1}, {&answer, 1});
  const Query query = bag->asked(ray);
  EXPECT_EQ(query.ray.direction.x, 0x1p-52);  // 1 + 0x1.8p-53 is rounded
  EXPECT_EQ(query.ray.direction.z, -0x1p+0);  // -1 - 2^-60 in two parts
  EXPECT_EQ(query.direction_tail, (Vec3{0, 0, -0x1p-60}));
}

TEST_F(CgalAabbTree, FaultsWhereThereIsNoRay) {
  constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(outcome({{0, 0, 1}, {0, 0, 0}}), Outcome::fault);
  EXPECT_EQ(outcome({{0, 0, 1}, {0, 0, 0x1p-60}}), Outcome::fault);
  EXPECT_EQ(outcome({{0, 0, nan}, {0, 0, 1}}), Outcome::fault);
  EXPECT_EQ(outcome({{0, 0, 1}, {0, inf, 1}}), Outcome::fault);
  EXPECT_EQ(shoot_at({{{0, 0, 0}, {inf, 0, 0}, {0, 1, 0}}}, {{0, 0, 1}, {0, 0, -1}}).outcome, Outcome::fault);
}

}  // namespace
}  // namespace plumbline
