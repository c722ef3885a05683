// What is left of passages woven into partitions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "float_tracer/brlcad/weave.h"

namespace plumbline::brlcad {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double little = 0x1p-11;  // below 0.0005; twice that is above

std::vector<Passage> woven(std::vector<Passage> passages) {
  Weaver weaver;
  std::vector<Passage> partitions;
  weaver.weave(passages, partitions);
  return partitions;
}
std::vector<Passage> woven(double in, double out) { return woven({{in, out, 0, 1}}); }

// ---- One

TEST(BrlcadWeave, KeepsWhatLiesAhead) { EXPECT_THAT(woven(4.75, 5.25), ElementsAre(Passage{4.75, 5.25, 0, 1})); }

TEST(BrlcadWeave, KeepsAPlateAroundTheOrigin) {
  EXPECT_THAT(woven(-0.25, 0.25), ElementsAre(Passage{-0.25, 0.25, 0, 1}));
}

TEST(BrlcadWeave, DropsWhatLiesBehindOrEndsAtTheOrigin) {
  EXPECT_THAT(woven(-2, -1), IsEmpty());
  EXPECT_THAT(woven(-1, little), IsEmpty());  // becomes 0
  EXPECT_THAT(woven(little, little), IsEmpty());
  EXPECT_THAT(woven(2, 1), IsEmpty());
}

TEST(BrlcadWeave, DropsWhatHasANaN) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(woven(nan, 1), IsEmpty());
  EXPECT_THAT(woven(1, nan), IsEmpty());
  EXPECT_THAT(woven(nan, nan), IsEmpty());
}

TEST(BrlcadWeave, SnapsToTheOrigin) {
  EXPECT_THAT(woven(-little, 1), ElementsAre(Passage{0, 1, 0, 1}));
  EXPECT_THAT(woven(2 * little, 1), ElementsAre(Passage{2 * little, 1, 0, 1}));
}

TEST(BrlcadWeave, ClosesAThinGap) {
  EXPECT_THAT(woven(1, 1 + little), ElementsAre(Passage{1, 1, 0, 1}));
  EXPECT_THAT(woven(1, 1 + 2 * little), ElementsAre(Passage{1, 1 + 2 * little, 0, 1}));
}

// ---- Several

TEST(BrlcadWeave, SortsWhatIsApart) {
  EXPECT_THAT(woven({{5, 6, 0, 1}, {1, 2, 2, 3}, {3, 4, 4, 5}}),
              ElementsAre(Passage{1, 2, 2, 3}, Passage{3, 4, 4, 5}, Passage{5, 6, 0, 1}));
  EXPECT_THAT(woven({{5, 5, 0, 0}, {1, 1, 1, 1}, {3, 3, 2, 2}}),
              ElementsAre(Passage{1, 1, 1, 1}, Passage{3, 3, 2, 2}, Passage{5, 5, 0, 0}));
}

TEST(BrlcadWeave, WhatOverlapsOrTouchesIsOne) {
  const auto one = ElementsAre(Passage{1, 4, 0, 3});
  EXPECT_THAT(woven({{1, 3, 0, 1}, {2, 4, 2, 3}}), one);
  EXPECT_THAT(woven({{2, 4, 2, 3}, {1, 3, 0, 1}}), one);
  EXPECT_THAT(woven({{1, 2, 0, 1}, {2, 4, 2, 3}}), one);
  EXPECT_THAT(woven({{1, 2, 0, 1}, {2 + little, 4, 2, 3}}), one);
  EXPECT_THAT(woven({{2, 3, 1, 2}, {1, 4, 0, 3}}), one);
  EXPECT_THAT(woven({{1, 4, 0, 3}, {2, 3, 1, 2}}), one);
  EXPECT_THAT(woven({{1, 4, 0, 3}, {1, 4, 1, 2}}), one);
  EXPECT_THAT(woven({{1, 2, 0, 1}, {2 + 2 * little, 4, 2, 3}}).size(), 2u);
}

TEST(BrlcadWeave, OneWithoutLengthIsLeftOutWhereAnotherIs) {
  EXPECT_THAT(woven({{1, 4, 0, 1}, {1, 1, 2, 2}, {2, 2, 2, 2}, {4 + little, 4 + little, 2, 2}}),
              ElementsAre(Passage{1, 4, 0, 1}));
  EXPECT_THAT(woven({{3, 3, 0, 0}, {3, 3, 1, 1}, {3 + little, 3 + little, 2, 2}}), ElementsAre(Passage{3, 3, 0, 0}));
  EXPECT_THAT(woven({{1, 4, 0, 1}, {5, 5, 2, 2}, {0.5, 0.5, 3, 3}}),
              ElementsAre(Passage{0.5, 0.5, 3, 3}, Passage{1, 4, 0, 1}, Passage{5, 5, 2, 2}));
}

TEST(BrlcadWeave, TheNearerOfTwoBeginsCounts) {
  EXPECT_THAT(woven({{1 + little, 4, 0, 1}, {1, 4, 2, 3}}), ElementsAre(Passage{1, 4, 2, 1}));
  EXPECT_THAT(woven({{1, 4, 0, 1}, {1 + little, 4, 2, 3}}), ElementsAre(Passage{1, 4, 0, 1}));
}

TEST(BrlcadWeave, OnlyTheLastEndCountsForWhatReachesBehindTheOrigin) {
  EXPECT_THAT(woven({{-3, -1, 0, 1}, {-2, 2, 2, 3}}), ElementsAre(Passage{-1, 2, 1, 3}));
  EXPECT_THAT(woven({{-20, -11, 0, 1}, {-15, 2, 2, 3}}), ElementsAre(Passage{-15, 2, 2, 3}));
}

TEST(BrlcadWeave, KeepsNothingFromTheRayBefore) {
  Weaver weaver;
  std::vector<Passage> partitions, first = {{1, 2, 0, 0}, {3, 4, 0, 0}}, second = {{5, 6, 1, 1}}, none;
  weaver.weave(first, partitions);
  EXPECT_EQ(partitions.size(), 2u);
  weaver.weave(second, partitions);
  EXPECT_THAT(partitions, ElementsAre(Passage{5, 6, 1, 1}));
  weaver.weave(none, partitions);
  EXPECT_THAT(partitions, IsEmpty());
}

}  // namespace
}  // namespace plumbline::brlcad
