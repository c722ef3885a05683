#include <gtest/gtest.h>

#include <limits>

#include "float_tracer/brlcad/segment.h"

namespace plumbline::brlcad {
namespace {

// Of a face with the unit normal (0, 0, 1).
Bag plate(double thickness, PlatePosition position, bool cosine) {
  return {.triangles = {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}},
          .mode = BagMode::plate,
          .thickness = thickness,
          .position = position,
          .cosine = cosine};
}

// Against a ray that falls at cos = 4/5: (3, 0, -4) is five long, and direction . normal = -4.
void expect_segment(const Bag& bag, double in, double out) {
  const auto segment = segment_at(*prepare_solid(bag), {3, 0, -4}, 10);
  ASSERT_TRUE(segment);
  EXPECT_EQ(segment->in, in);
  EXPECT_EQ(segment->out, out);
}

TEST(BrlcadSegment, PlateIsCrossedOverThicknessByCosine) {
  // 2 / (4/5) = 2.5 long, in units of the direction's five: 0.5.
  expect_segment(plate(2, PlatePosition::centred, true), 9.75, 10.25);
  expect_segment(plate(2, PlatePosition::appended, true), 10, 10.5);
}

TEST(BrlcadSegment, PlateWithoutCosineAddsTheThicknessToTheParameter) {
  expect_segment(plate(2, PlatePosition::centred, false), 9, 11);
  expect_segment(plate(2, PlatePosition::appended, false), 10, 12);
}

TEST(BrlcadSegment, SurfacesAndUnorientedSolidsHaveNoThickness) {
  Bag bag = plate(2, PlatePosition::centred, true);
  bag.mode = BagMode::surface;
  expect_segment(bag, 10, 10);
  bag.mode = BagMode::solid;
  expect_segment(bag, 10, 10);
}

TEST(BrlcadSegment, ALoneFaceOfAnOrientedSolidIsDropped) {
  Bag bag = plate(2, PlatePosition::centred, true);
  bag.mode = BagMode::solid;
  for (const Orientation orientation : {Orientation::ccw, Orientation::cw}) {
    bag.orientation = orientation;
    EXPECT_FALSE(segment_at(*prepare_solid(bag), {3, 0, -4}, 10));
  }
}

TEST(BrlcadSegment, ALoneFaceOfAnOrientedSolidIsKeptWhereItsUnitNormalHasNoSlope) {
  Bag bag = plate(2, PlatePosition::centred, true);
  bag.mode = BagMode::solid;
  bag.orientation = Orientation::ccw;
  const auto segment = segment_at(*prepare_solid(bag), {3, 4, 0}, 10);
  ASSERT_TRUE(segment);
  EXPECT_EQ(segment->in, 10);
  EXPECT_EQ(segment->out, 10);
  // |ab x ac| = 2^600 has an infinite square, and the unit normal becomes zero.
  bag.triangles = {{{0, 0, 0}, {0x1p+300, 0, 0}, {0, 0x1p+300, 0}}};
  EXPECT_TRUE(segment_at(*prepare_solid(bag), {3, 0, -4}, 10));
}

TEST(BrlcadWeave, KeepsWhatLiesAhead) {
  const auto s = weave({4.75, 5.25});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->in, 4.75);
  EXPECT_EQ(s->out, 5.25);
}

TEST(BrlcadWeave, KeepsAPlateAroundTheOrigin) {
  const auto s = weave({-0.25, 0.25});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->in, -0.25);
  EXPECT_EQ(s->out, 0.25);
}

TEST(BrlcadWeave, DropsWhatLiesBehindOrEndsAtTheOrigin) {
  EXPECT_FALSE(weave({-2, -1}));
  EXPECT_FALSE(weave({-1, 0x1p-11}));  // 0.000488 becomes 0
  EXPECT_FALSE(weave({0x1p-11, 0x1p-11}));
  EXPECT_FALSE(weave({2, 1}));
}

TEST(BrlcadWeave, DropsWhatHasANaN) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(weave({nan, 1}));
  EXPECT_FALSE(weave({1, nan}));
  EXPECT_FALSE(weave({nan, nan}));
}

TEST(BrlcadWeave, SnapsToTheOrigin) {
  const auto s = weave({-0x1p-11, 1});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->in, 0);
  EXPECT_EQ(weave({0x1p-10, 1})->in, 0x1p-10);
}

TEST(BrlcadWeave, ClosesAThinGap) {
  EXPECT_EQ(weave({1, 1 + 0x1p-11})->out, 1);
  EXPECT_EQ(weave({1, 1 + 0x1p-10})->out, 1 + 0x1p-10);
}

}  // namespace
}  // namespace plumbline::brlcad
