#include <gtest/gtest.h>

#include <optional>

#include "float_tracer/brlcad/solid.h"

namespace plumbline::brlcad {
namespace {

// None: the face was dropped.
std::optional<Face> prepare(const Triangle& triangle) {
  const Solid solid = prepare_solid({.triangles = {triangle}});
  return solid.faces.empty() ? std::nullopt : std::optional(solid.faces[0]);
}

void expect_box(const Box& box, const Vec3& low, const Vec3& high) {
  EXPECT_EQ((Vec3{box.low.x, box.low.y, box.low.z}), low);
  EXPECT_EQ((Vec3{box.high.x, box.high.y, box.high.z}), high);
}

TEST(BrlcadSolid, DropsAFaceWithAShortEdge) {
  // 0.0005 lies between 2^-11 and 2^-10.
  EXPECT_FALSE(prepare({{0, 0, 0}, {0x1p-11, 0, 0}, {0, 64, 0}}));
  EXPECT_FALSE(prepare({{0, 0, 0}, {0, 64, 0}, {0x1p-11, 0, 0}}));
  EXPECT_FALSE(prepare({{0, 64, 0}, {0, 0, 0}, {0x1p-11, 0, 0}}));
  EXPECT_TRUE(prepare({{0, 0, 0}, {0x1p-10, 0, 0}, {0, 64, 0}}));
  EXPECT_TRUE(prepare({{0, 64, 0}, {0, 0, 0}, {0x1p-10, 0, 0}}));
}

TEST(BrlcadSolid, DropsAFaceOfSmallAreaHoweverLongItsEdges) {
  // Legs of 1/64 are 31 times the tolerance, but |ab x ac| = 2^-12 is a length squared and still below 0.0005.
  EXPECT_FALSE(prepare({{0, 0, 0}, {0x1p-6, 0, 0}, {0, 0x1p-6, 0}}));
  EXPECT_TRUE(prepare({{0, 0, 0}, {0x1p-5, 0, 0}, {0, 0x1p-5, 0}}));
  EXPECT_FALSE(prepare({{0, 0, 0}, {64, 0, 0}, {32, 0x1p-18, 0}}));
}

TEST(BrlcadSolid, NormalHasUnitLengthUnlessItNearlyDoesAlready) {
  EXPECT_EQ(prepare({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}})->unit_normal.z, 1);
  // |N|^2 - 1 = 2^-24 + 2^-50 is below 2^-23: kept. 2^-22 is not.
  EXPECT_EQ(prepare({{0, 0, 0}, {1, 0, 0}, {0, 1 + 0x1p-25, 0}})->unit_normal.z, 1 + 0x1p-25);
  EXPECT_EQ(prepare({{0, 0, 0}, {1, 0, 0}, {0, 1 + 0x1p-23, 0}})->unit_normal.z, 1);
}

TEST(BrlcadSolid, ModelBoxIsRoundedOutwardsToWholeNumbers) {
  const std::vector<Triangle> triangles = {{{0.5, -0.5, 1.25}, {1.5, 2, 3}, {-0.25, 0, 2}}};
  expect_box(box_of(triangles), {-0.25, -0.5, 1.25}, {1.5, 2, 3});
  expect_box(model_box_of(thickened(box_of(triangles))), {-1, -1, 1}, {2, 2, 3});
}

TEST(BrlcadSolid, OnlyAFlatAxisIsWidened) {
  // z is flat, so it grows by 0.0005 before it is rounded; the whole numbers of x and y stay where they are.
  const std::vector<Triangle> triangles = {{{0, 0, 3}, {2, 0, 3}, {0, 2, 3}}};
  expect_box(box_of(triangles), {0, 0, 3}, {2, 2, 3});
  expect_box(model_box_of(thickened(box_of(triangles))), {0, 0, 2}, {2, 2, 4});
}

TEST(BrlcadSolid, FacesAreDroppedOneByOneAndTheRestKeepTheirNumbers) {
  const Triangle good{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, point{{9, 9, 9}, {9, 9, 9}, {9, 9, 9}};
  const std::vector<Triangle> triangles = {point, good, point, point, good};
  const Solid solid = prepare_solid({.triangles = triangles});
  ASSERT_EQ(solid.faces.size(), 2u);
  EXPECT_EQ(solid.faces[0].index, 1u);
  EXPECT_EQ(solid.faces[1].index, 4u);
  expect_box(box_of(triangles), {0, 0, 0}, {9, 9, 9});  // the dropped ones count here
}

TEST(BrlcadSolid, ClockwiseTurnsTheSlope) {
  Bag bag{.triangles = {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}}};
  for (const Orientation orientation : {Orientation::none, Orientation::ccw}) {
    bag.orientation = orientation;
    const Solid solid = prepare_solid(bag);
    EXPECT_EQ(solid.slope(solid.faces[0], {3, 0, -4}), -4);
  }
  bag.orientation = Orientation::cw;
  const Solid solid = prepare_solid(bag);
  EXPECT_EQ(solid.slope(solid.faces[0], {3, 0, -4}), 4);
}

TEST(BrlcadSolid, OnlyAnOrientedSolidIsOriented) {
  Bag bag{.triangles = {{{0, 0, 0}, {3, 0, 0}, {0, 8, 0}}}};
  for (const BagMode mode : {BagMode::surface, BagMode::solid, BagMode::plate})
    for (const Orientation orientation : {Orientation::none, Orientation::ccw, Orientation::cw}) {
      bag.mode = mode, bag.orientation = orientation;
      EXPECT_EQ(prepare_solid(bag).oriented(), mode == BagMode::solid && orientation != Orientation::none);
    }
  EXPECT_EQ(half_longest_side(box_of(bag.triangles)), 4);
}

}  // namespace
}  // namespace plumbline::brlcad
