#include "oracle/bag/segments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "case/float_bits.h"
#include "tests/oracle/bag/bags.h"
#include "tests/oracle/float_environment.h"

namespace plumbline {
namespace {

using Segments = std::vector<RaySegment>;
constexpr double infinity = std::numeric_limits<double>::infinity();

Ray along_x(double y, double z) { return {.origin = {-3, y, z}, .direction = {1, 0, 0}}; }

TEST(Inside, OfABox) {
  const auto bag = box({-1, -1, -1}, {1, 1, 1});
  EXPECT_EQ(inside(bag, along_x(0.5, 0.25)), (Segments{{2, 4}}));
  EXPECT_EQ(inside(bag, along_x(0, 0)), (Segments{{2, 4}}));  // diagonals
  EXPECT_EQ(inside(bag, along_x(2, 0)), Segments{});
  EXPECT_EQ(inside(bag, Ray{.origin = {-3, -1, 0}, .direction = {1, 1, 0}}), Segments{});           // touches an edge
  EXPECT_EQ(inside(bag, Ray{.origin = {-2, -2, -2}, .direction = {1, 1, 1}}), (Segments{{1, 3}}));  // vertices
}

TEST(Inside, IsCutByTheRange) {
  const auto bag = box({-1, -1, -1}, {1, 1, 1});
  const Ray from_within{.origin = {0, 0.5, 0.25}, .direction = {1, 0, 0}};
  EXPECT_EQ(inside(bag, from_within), (Segments{{0, 1}}));
  Ray ray = along_x(0.5, 0.25);
  ray.t_max = 2.5;
  EXPECT_EQ(inside(bag, ray), (Segments{{2, 2.5}}));
  ray.t_max = 1;
  EXPECT_EQ(inside(bag, ray), Segments{});
  ray = from_within;
  ray.t_min = -infinity;
  EXPECT_EQ(inside(bag, ray), (Segments{{-1, 1}}));
}

TEST(Inside, OfTwoBoxes) {
  auto bag = box({0, 0, 0}, {1, 2, 2});
  for (const Triangle& t : box({3, 0, 0}, {4, 2, 2})) bag.push_back(t);
  EXPECT_EQ(inside(bag, along_x(0.5, 0.75)), (Segments{{3, 4}, {6, 7}}));
}

TEST(Inside, IsNotKnown) {
  const auto bag = box({-1, -1, -1}, {1, 1, 1});
  EXPECT_EQ(inside(bag, Ray{.origin = {-1, 0, 0}, .direction = {1, 0, 0}}), std::nullopt);  // on the surface
  auto open = bag;
  open.erase(open.begin() + 10, open.end());
  EXPECT_EQ(inside(open, along_x(0.5, 0.25)), std::nullopt);
  EXPECT_EQ(inside(bag, Ray{.origin = {}, .direction = {}}), std::nullopt);
  EXPECT_EQ(inside(bag, Ray{.origin = {-3, 0, 0}, .direction = {1, 0, 0}, .t_min = NAN}), std::nullopt);
}

// The tetrahedron at the origin.
std::vector<Triangle> corner(double size) {
  const Vec3 o, x = {size, 0, 0}, y = {0, size, 0}, z = {0, 0, size};
  return {{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}};
}

TEST(Inside, HasNoPiecesOfNoLength) {
  const Ray up{.origin = {0.25, 0.25, -1}, .direction = {0, 0, 1}};
  EXPECT_EQ(inside(corner(1), up), (Segments{{1, 1.5}}));
  const auto between = [&](double low, double high) {
    Ray ray = up;
    ray.t_min = low;
    ray.t_max = high;
    return inside(corner(1), ray);
  };
  EXPECT_EQ(between(1.5, 3), Segments{});
  EXPECT_EQ(between(0, 1), Segments{});
  EXPECT_EQ(between(1.25, 1.25), Segments{});
  EXPECT_EQ(between(1.25, 3), (Segments{{1.25, 1.5}}));
  // The entry is at 1/3, a hair beyond the range; rounded, it is its end.
  Ray slow = up;
  slow.direction.z = 3;
  slow.t_max = 0x1.5555555555555p-2;
  EXPECT_EQ(inside(corner(1), slow), Segments{});
}

TEST(Inside, IsTheSameInEveryEnvironment) {
  const Ray ray{.origin = {0x1p-42, 0x1p-42, -0x1p-40}, .direction = {0, 0, 0x1p+1000}};
  const auto expected = inside(corner(0x1p-40), ray);
  ASSERT_TRUE(expected);
  ASSERT_EQ(expected->size(), 1u);
  Ray before = ray;  // of the entry, at 2^-1040
  before.t_min = 0x1p-1050;
  before.t_max = 0x1p-1041;
  for (const FloatEnvironment& environment : float_environments()) {
    std::optional<std::vector<RaySegment>> whole, none;
    {
      const FloatScope scope(environment);
      whole = inside(corner(0x1p-40), ray);
      none = inside(corner(0x1p-40), before);
    }
    ASSERT_TRUE(whole && none) << environment;
    ASSERT_EQ(whole->size(), 1u) << environment;
    EXPECT_EQ(to_bits(whole->front().in), to_bits(expected->front().in)) << environment;
    EXPECT_EQ(to_bits(whole->front().out), to_bits(expected->front().out)) << environment;
    EXPECT_TRUE(none->empty()) << environment;
  }
}

Bag plate_of(const Triangle& face, double thickness) {
  return {.triangles = {face}, .mode = BagMode::plate, .thickness = thickness};
}

TEST(Plate, SquareOn) {
  Bag bag = plate_of({{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}, 0.5);
  const Ray ray{.origin = {1, 1, 0}, .direction = {0, 0, 2}};
  EXPECT_EQ(plate(bag, 0, ray), (RaySegment{0x1.8p-2, 0x1.4p-1}));  // 0.5 -+ 0.125
  bag.position = PlatePosition::appended;
  EXPECT_EQ(plate(bag, 0, ray), (RaySegment{0x1p-1, 0x1.8p-1}));
  bag.cosine = false;
  EXPECT_EQ(plate(bag, 0, ray), (RaySegment{0x1p-1, 0x1.8p-1}));
  bag.thickness = 0;
  EXPECT_EQ(plate(bag, 0, ray), (RaySegment{0x1p-1, 0x1p-1}));
}

TEST(Plate, AtASlant) {
  // 45 degrees: L = thickness * sqrt(2), in lengths of the direction thickness.
  Bag bag = plate_of({{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}, 1);
  const Ray ray{.origin = {0, 1, 0}, .direction = {1, 0, 1}};
  EXPECT_EQ(plate(bag, 0, ray), (RaySegment{0x1p-1, 0x1.8p+0}));
  bag.cosine = false;  // L = thickness, in lengths of the direction 1/sqrt(2): t -+ sqrt(2)/4
  EXPECT_EQ(plate(bag, 0, ray), (RaySegment{0x1.4afb0ccc0621ap-1, 0x1.5a827999fcef3p+0}));
  // The normal (1, 1, 1) of length sqrt(3), D = (0, 0, 1): t = 1/3, L = sqrt(3)
  Bag tilted = plate_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1);
  tilted.position = PlatePosition::appended;
  const Ray up{.origin = {0.5, 0.5 - 0x1.5555555555555p-2, 0}, .direction = {0, 0, 1}};
  const auto through = plate(tilted, 0, up);
  ASSERT_TRUE(through);
  EXPECT_EQ(through->in, 0x1.5555555555555p-2);
  EXPECT_EQ(through->out, 0x1.085e81ed6d100p+1);  // the plane is x + y + z = 1
}

TEST(Plate, IsNotThereBesideTheTriangle) {
  const Bag bag = plate_of({{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}, 1);
  EXPECT_EQ(plate(bag, 0, Ray{.origin = {-1, 1, 0}, .direction = {0, 0, 1}}), std::nullopt);
  EXPECT_EQ(plate(bag, 0, Ray{.origin = {-1, 1, 1}, .direction = {1, 0, 0}}), std::nullopt);  // in its plane
  EXPECT_TRUE(plate(bag, 0, Ray{.origin = {0, 0, 0}, .direction = {0, 0, 1}}));               // a vertex
}

}  // namespace
}  // namespace plumbline
