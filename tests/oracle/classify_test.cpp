#include "oracle/classify.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "oracle/contact.h"

namespace plumbline {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double least = 0x1p-1074, largest = 0x1.fffffffffffffp+1023;

// Legs of length 1 in z = 0; rays come down from z = 1, so they meet its front and t = 1.
const Triangle unit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
Ray down(double x, double y) { return {{x, y, 1}, {0, 0, -1}}; }

std::optional<bool> hit_of(const Triangle& triangle, const Ray& ray) { return hit(triangle, ray, classify(triangle, ray)); }

struct Place {
  double x, y;
  HitClass hit_class;
  Feature feature;
};

TEST(Classify, InteriorEdgesVerticesAndJustOutside) {
  const Place places[] = {
      {0.25, 0.25, HitClass::interior, Feature::none},
      {0.5, 0, HitClass::edge, Feature::ab},
      {0.5, 0.5, HitClass::edge, Feature::bc},
      {0, 0.5, HitClass::edge, Feature::ca},
      {0, 0, HitClass::vertex, Feature::a},
      {1, 0, HitClass::vertex, Feature::b},
      {0, 1, HitClass::vertex, Feature::c},
      {0.5, least, HitClass::interior, Feature::none},
      {0.5, -least, HitClass::exterior, Feature::none},
      {least, 0.5, HitClass::interior, Feature::none},
      {-least, 0.5, HitClass::exterior, Feature::none},
      {0.5, 0x1.fffffffffffffp-2, HitClass::interior, Feature::none},
      {0.5, 0x1.0000000000001p-1, HitClass::exterior, Feature::none},
      {-least, 0, HitClass::exterior, Feature::none},
      {0x1.0000000000001p+0, 0, HitClass::exterior, Feature::none},
      {largest, largest, HitClass::exterior, Feature::none},
  };
  for (const Place& p : places) {
    const Truth truth = classify(unit, down(p.x, p.y));
    EXPECT_EQ(truth.hit_class, p.hit_class) << p.x << ' ' << p.y;
    EXPECT_EQ(truth.feature, p.feature) << p.x << ' ' << p.y;
    EXPECT_EQ(truth.det_sign, -1);
    EXPECT_EQ(hit_of(unit, down(p.x, p.y)), p.hit_class != HitClass::exterior);
  }
}

TEST(Classify, TheRangeIsClosed) {
  struct { double low, high; signed char versus_low, versus_high; bool hit; } const ranges[] = {
      {0, inf, 1, -1, true},    {1, inf, 0, -1, true},     {0, 1, 1, 0, true},      {1, 1, 0, 0, true},
      {0x1.0000000000001p+0, inf, -1, -1, false},          {0, 0x1.fffffffffffffp-1, 1, 1, false},
      {-inf, inf, 1, -1, true}, {2, 0, -1, 1, false},      {1, 0.5, 0, 1, false},   {inf, inf, -1, -1, false},
      {-inf, -inf, 1, 1, false}, {-inf, 1, 1, 0, true},    {-largest, largest, 1, -1, true}};
  for (const auto& r : ranges) {
    Ray ray = down(0.25, 0.25);
    ray.t_min = r.low;
    ray.t_max = r.high;
    const Truth truth = classify(unit, ray);
    EXPECT_EQ(truth.hit_class, HitClass::interior);
    EXPECT_EQ(truth.versus_t_min, r.versus_low) << r.low << ' ' << r.high;
    EXPECT_EQ(truth.versus_t_max, r.versus_high) << r.low << ' ' << r.high;
    EXPECT_EQ(hit_of(unit, ray), r.hit) << r.low << ' ' << r.high;
  }
}

TEST(Classify, TheOriginOnThePlaneAndBehindIt) {
  Ray ray = down(0.25, 0.25);
  ray.origin.z = 0;
  EXPECT_EQ(hit_of(unit, ray), true);
  ray.origin.z = -0.0;
  EXPECT_EQ(classify(unit, ray).versus_t_min, 0);
  ray.origin.z = -least;
  EXPECT_EQ(hit_of(unit, ray), false);
  EXPECT_EQ(classify(unit, ray).hit_class, HitClass::interior);
  ray.t_min = -inf;
  EXPECT_EQ(hit_of(unit, ray), true);
}

TEST(Classify, BothSidesAndBothWindings) {
  Ray up = {{0.25, 0.25, -1}, {0, 0, 1}};
  EXPECT_EQ(classify(unit, up).det_sign, 1);
  EXPECT_EQ(hit_of(unit, up), true);
  const Triangle flipped{unit.a, unit.c, unit.b};
  EXPECT_EQ(classify(flipped, up).det_sign, -1);
  EXPECT_EQ(classify(flipped, down(0.5, 0)).feature, Feature::ca);
}

TEST(Classify, ParallelAndCoplanar) {
  const auto along_x = [](double x, double y, double z) { return Ray{{x, y, z}, {1, 0, 0}}; };
  EXPECT_EQ(classify(unit, along_x(-1, 0.25, least)).hit_class, HitClass::parallel);
  EXPECT_EQ(hit_of(unit, along_x(-1, 0.25, 1)), false);
  struct { double x, y; bool touches; } const lines[] = {
      {-1, 0.25, true}, {-1, 0, true}, {-1, 1, true}, {-1, 0x1.0000000000001p+0, false}, {-1, -least, false},
      {0.25, 0.25, true}, {0.75, 0.25, true}, {0x1.8000000000001p-1, 0.25, false}, {1, 0, true}, {2, 0, false}};
  for (const auto& l : lines) {
    const Truth truth = classify(unit, along_x(l.x, l.y, 0));
    EXPECT_EQ(truth.hit_class, HitClass::coplanar);
    EXPECT_EQ(touches(unit, along_x(l.x, l.y, 0)), l.touches) << l.x << ' ' << l.y;
    EXPECT_EQ(hit_of(unit, along_x(l.x, l.y, 0)), l.touches ? std::nullopt : std::optional(false));
  }
  Ray ends_before = along_x(-1, 0.25, 0);
  ends_before.t_max = 0x1.fffffffffffffp-1;
  EXPECT_FALSE(touches(unit, ends_before));
  ends_before.t_max = 1;
  EXPECT_TRUE(touches(unit, ends_before));
  ends_before.t_min = 1.5, ends_before.t_max = 1.25;
  EXPECT_FALSE(touches(unit, ends_before));
}

TEST(Classify, DegenerateSegmentsAndPoints) {
  const Triangle segment{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  const Triangle point{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
  const Triangle needle{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  for (const Triangle& t : {segment, point, needle}) EXPECT_EQ(classify(t, down(0, 0)).hit_class, HitClass::degenerate);
  EXPECT_TRUE(touches(segment, Ray{{1.5, 1.5, 0}, {0, 0, 1}}));
  EXPECT_TRUE(touches(segment, Ray{{2, 2, 0}, {0, 0, 1}}));
  EXPECT_FALSE(touches(segment, Ray{{2.5, 2.5, 0}, {0, 0, 1}}));
  EXPECT_FALSE(touches(segment, Ray{{1.5, 0x1.8000000000001p+0, 0}, {0, 0, 1}}));
  EXPECT_FALSE(touches(segment, Ray{{1.5, 1.5, 2}, {0, 0, 1}}));   // behind the origin
  EXPECT_TRUE(touches(segment, Ray{{-1, -1, -1}, {1, 1, 1}}));     // along it
  EXPECT_FALSE(touches(segment, Ray{{-1, -1, -1}, {-1, -1, -1}}));  // away from it
  EXPECT_FALSE(touches(segment, Ray{{-1, -1, 0}, {1, 1, 1}}));     // beside it
  EXPECT_TRUE(touches(point, Ray{{0, 0, 0}, {1, 2, 3}}));
  EXPECT_FALSE(touches(point, Ray{{0, 0, 0}, {1, 2, 0x1.8000000000001p+1}}));
  EXPECT_FALSE(touches(point, Ray{{0, 0, 0}, {1, 2, 3}, 0, 0.5}));
  EXPECT_TRUE(touches(needle, Ray{{0.5, 0, 1}, {0, 0, -1}}));
  EXPECT_FALSE(touches(needle, Ray{{0.5, least, 1}, {0, 0, -1}}));
}

TEST(Classify, InvalidSaysWhy) {
  const Ray ray = down(0.25, 0.25);
  for (const double bad : {nan, inf, -inf}) {
    EXPECT_EQ(classify({{bad, 0, 0}, unit.b, unit.c}, ray).invalid, Invalid::triangle_not_finite);
    EXPECT_EQ(classify({unit.a, unit.b, {0, 0, bad}}, ray).invalid, Invalid::triangle_not_finite);
    EXPECT_EQ(classify(unit, {{0, bad, 0}, ray.direction}).invalid, Invalid::origin_not_finite);
    EXPECT_EQ(classify(unit, {ray.origin, {0, bad, 1}}).invalid, Invalid::direction_not_finite);
  }
  EXPECT_EQ(classify(unit, {ray.origin, {0, -0.0, 0}}).invalid, Invalid::zero_direction);
  EXPECT_EQ(classify(unit, {ray.origin, ray.direction, nan, 1}).invalid, Invalid::range_nan);
  EXPECT_EQ(classify(unit, {ray.origin, ray.direction, 0, nan}).invalid, Invalid::range_nan);
  const Truth truth = classify(unit, {ray.origin, {0, 0, 0}});
  EXPECT_EQ(truth.hit_class, HitClass::invalid);
  EXPECT_EQ(hit_of(unit, {ray.origin, {0, 0, 0}}), std::nullopt);
}

TEST(Classify, SmallestAndLargestNumbersAreOrdinaryOnes) {
  const Triangle tiny{{0, 0, 0}, {least, 0, 0}, {0, least, 0}};
  EXPECT_EQ(classify(tiny, {{0, 0, 1}, {0, 0, -1}}).feature, Feature::a);
  EXPECT_EQ(classify(tiny, {{least, least, 1}, {0, 0, -1}}).hit_class, HitClass::exterior);
  EXPECT_EQ(classify(tiny, {{0, 0, least}, {0, 0, -least}, 1, 1}).versus_t_min, 0);
  const Triangle huge{{-largest, -largest, largest}, {largest, -largest, largest}, {0, largest, largest}};
  EXPECT_EQ(classify(huge, {{0, 0, -largest}, {0, 0, largest}}).hit_class, HitClass::interior);
  EXPECT_EQ(classify(huge, {{0, largest, 0}, {0, 0, least}}).feature, Feature::c);
}

TEST(Classify, BatchesAreTheSingleCallRepeated) {
  std::vector<Ray> rays;
  for (double x = -0.25; x <= 1.25; x += 0.25)
    for (double y = -0.25; y <= 1.25; y += 0.25) rays.push_back(down(x, y));
  rays.push_back({{nan, 0, 0}, {0, 0, 1}});
  std::vector<Truth> expected, truths(rays.size());
  for (const Ray& ray : rays) expected.push_back(classify(unit, ray));
  classify(unit, rays, truths);
  EXPECT_EQ(truths, expected);

  std::array<std::vector<double>, 8> ray_column;
  std::array<std::vector<double>, 9> triangle_column;
  for (const Ray& r : rays) {
    const double row[] = {r.origin.x, r.origin.y, r.origin.z, r.direction.x, r.direction.y, r.direction.z, r.t_min, r.t_max};
    for (std::size_t k = 0; k < 8; ++k) ray_column[k].push_back(row[k]);
    const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (std::size_t k = 0; k < 9; ++k) triangle_column[k].push_back(corners[k]);
  }
  RayColumns ray_columns{.size = rays.size()};
  TriangleColumns triangle_columns{.size = rays.size()};
  for (std::size_t k = 0; k < 8; ++k) ray_columns.column[k] = ray_column[k].data();
  for (std::size_t k = 0; k < 9; ++k) triangle_columns.column[k] = triangle_column[k].data();
  truths.assign(rays.size(), Truth{});
  classify(unit, ray_columns, truths);
  EXPECT_EQ(truths, expected);
  truths.assign(rays.size(), Truth{});
  classify(triangle_columns, ray_columns, truths);
  EXPECT_EQ(truths, expected);
}

}  // namespace
}  // namespace plumbline
