#include <gtest/gtest.h>

#include "float_tracer/brlcad/walk.h"

namespace plumbline::brlcad {
namespace {

const Box box{{0, 0, -1}, {2, 2, 1}};

TEST(BrlcadWalk, MovesTheOriginJustInsideTheBox) {
  const auto entry = enter(box, {0.5, 0.5, 5}, {0, 0, -1});
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->moved, 4 + 0.0005);
  EXPECT_EQ(entry->point.z, 5 - (4 + 0.0005));
  EXPECT_EQ(entry->box_near, (1 - entry->point.z) * -1);
}

TEST(BrlcadWalk, DistancesAreParametersOfTheDirectionAsGiven) {
  EXPECT_EQ(enter(box, {0.5, 0.5, 5}, {0, 0, -2})->moved, 2 + 0.0005);
}

TEST(BrlcadWalk, LooksBackNoFartherThanTwo) {
  const Box deep{{0, 0, 0}, {2, 2, 16}};
  EXPECT_EQ(enter(deep, {1, 1, 8}, {0, 0, -1})->moved, -2 + 0.0005);
  EXPECT_EQ(enter(deep, {1, 1, 15}, {0, 0, -1})->moved, -1 + 0.0005);
}

TEST(BrlcadWalk, MissesABoxBesideOrBehind) {
  EXPECT_FALSE(enter(box, {3, 0.5, 5}, {0, 0, -1}));
  EXPECT_FALSE(enter(box, {0.5, 0.5, 5}, {0, 0, 1}));
  EXPECT_FALSE(enter(box, {0.5, 0.5, 5}, {1, 0, -1}));
  EXPECT_FALSE(enter(box, {0.5, 0.5, 1.25}, {0, 0, 1}));  // so near behind that looking back would reach it
}

TEST(BrlcadWalk, TheFacesOfTheBoxBelongToIt) {
  for (const double x : {0.0, 2.0})
    for (const double y : {0.0, 2.0}) EXPECT_TRUE(enter(box, {x, y, 5}, {0, 0, -1})) << x << " " << y;
}

// A ray through the corner x = y = 0: in at (2s, 0), out at (0, 2s). Its way through the box is 2s.
TEST(BrlcadWalk, LosesAWayThroughTheBoxShorterThanTheNudge) {
  const auto across_the_corner = [](double s) { return enter(box, {s + 1, s - 1, 1}, {-1, 1, -1}); };
  EXPECT_FALSE(across_the_corner(0x1p-13));  // 2s = 0.000244
  EXPECT_TRUE(across_the_corner(0x1p-11));   // 2s = 0.000977
}

TEST(BrlcadWalk, TreatsATinyComponentOfTheDirectionAsZero) {
  EXPECT_EQ(enter(box, {0.5, 0.5, 5}, {1e-39, -1e-39, -1})->direction.x, 0);
  EXPECT_EQ(enter(box, {0.5, 0.5, 5}, {1.1e-39, 0, -1})->direction.x, 1.1e-39);
  EXPECT_FALSE(enter(box, {-1, 0.5, 5}, {1e-39, 0, -1}));
}

const Box huge{{0, 0, -1e80}, {2, 2, 1e80}};

TEST(BrlcadWalk, GoesNoFartherThan1e73) {
  EXPECT_TRUE(enter(huge, {0.5, 0.5, 3e80}, {0, 0, -1e8}));   // t = 2e72
  EXPECT_FALSE(enter(huge, {0.5, 0.5, 3e80}, {0, 0, -1e6}));  // t = 2e74
}

// One over 1e78 counts as nothing: the component is taken for zero, except where the point is moved.
TEST(BrlcadWalk, TreatsAnEnormousComponentOfTheDirectionAsZero) {
  const auto entry = enter(huge, {0.5, 0.5, 5}, {0, 0, -1e78});
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->moved, -2 + 0.0005);
  EXPECT_EQ(entry->point.z, 5 + entry->moved * -1e78);
  EXPECT_EQ(entry->box_near, -1e73);
  EXPECT_FALSE(enter(huge, {0.5, 0.5, 3e80}, {0, 0, -1e78}));
}

}  // namespace
}  // namespace plumbline::brlcad
