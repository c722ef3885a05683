// What the hits of a ray make up, mode by mode.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "float_tracer/brlcad/passages.h"

namespace plumbline::brlcad {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double little = 0x1p-11;  // below 0.0005; twice that is above

Solid solid_of(BagMode mode, Orientation orientation = Orientation::none) {
  return {.faces = {},
          .mode = mode,
          .orientation = orientation,
          .thickness = 2,
          .position = PlatePosition::centred,
          .cosine = true};
}

std::vector<Passage> passages_of(const Solid& solid, std::vector<Hit> hits) {
  std::vector<Passage> passages;
  add_passages(solid, hits, passages);
  return passages;
}

// ---- Plates. The ray falls at cos = 4/5: (3, 0, -4) is five long, and direction . normal = -4.

std::vector<Passage> through(Solid plate) { return passages_of(plate, {{10, -4, 7}}); }

TEST(BrlcadPassages, PlateIsCrossedOverThicknessByCosine) {
  // 2 / (4/5) = 2.5 long, in units of the direction's five: 0.5.
  Solid plate = solid_of(BagMode::plate);
  EXPECT_THAT(through(plate), ElementsAre(Passage{9.75, 10.25, 7, 7}));
  plate.position = PlatePosition::appended;
  EXPECT_THAT(through(plate), ElementsAre(Passage{10, 10.5, 7, 7}));
}

TEST(BrlcadPassages, PlateWithoutCosineAddsTheThicknessToTheParameter) {
  Solid plate = solid_of(BagMode::plate);
  plate.cosine = false;
  EXPECT_THAT(through(plate), ElementsAre(Passage{9, 11, 7, 7}));
  plate.position = PlatePosition::appended;
  EXPECT_THAT(through(plate), ElementsAre(Passage{10, 12, 7, 7}));
}

TEST(BrlcadPassages, EveryHitOfAPlateOrSurfaceIsAPassage) {
  EXPECT_THAT(passages_of(solid_of(BagMode::plate), {{10, -4, 1}, {10, 4, 0}}),
              ElementsAre(Passage{9.75, 10.25, 1, 1}, Passage{9.75, 10.25, 0, 0}));
  EXPECT_THAT(passages_of(solid_of(BagMode::surface), {{3, 1, 5}, {3, 1, 2}, {4, -1, 3}}),
              ElementsAre(Passage{3, 3, 5, 5}, Passage{3, 3, 2, 2}, Passage{4, 4, 3, 3}));
}

// ---- Solids without orientation: the slopes don't count.

std::vector<Passage> unoriented(std::vector<Hit> hits) {
  return passages_of(solid_of(BagMode::solid), std::move(hits));
}

TEST(BrlcadPassages, UnorientedHitsArePairedInOrder) {
  EXPECT_THAT(unoriented({{1, 1, 0}, {2, 1, 1}, {4, 1, 2}, {8, 1, 3}}),
              ElementsAre(Passage{1, 2, 0, 1}, Passage{4, 8, 2, 3}));
}

TEST(BrlcadPassages, UnorientedLoneHitHasNoLength) {
  EXPECT_THAT(unoriented({{3, 1, 4}}), ElementsAre(Passage{3, 3, 4, 4}));
}

TEST(BrlcadPassages, UnorientedOddLastHitIsDropped) {
  EXPECT_THAT(unoriented({{1, 1, 0}, {2, 1, 1}, {4, 1, 2}}), ElementsAre(Passage{1, 2, 0, 1}));
}

TEST(BrlcadPassages, UnorientedHitsTogetherAreOneTheLast) {
  EXPECT_THAT(unoriented({{1, 1, 0}, {1, 1, 1}, {4, 1, 2}}), ElementsAre(Passage{1, 4, 1, 2}));
  // A chain: each is near to the next, not the first to the last.
  EXPECT_THAT(unoriented({{1, 1, 0}, {1 + little, 1, 1}, {1 + 2 * little, 1, 2}, {4, 1, 3}}),
              ElementsAre(Passage{1 + 2 * little, 4, 2, 3}));
}

TEST(BrlcadPassages, UnorientedTwoHitsTogetherAreAMiss) {
  EXPECT_THAT(unoriented({{3, 1, 0}, {3, -1, 1}}), IsEmpty());
  EXPECT_THAT(unoriented({{3, 1, 0}, {3 + little, -1, 1}}), IsEmpty());
  EXPECT_THAT(unoriented({{3, 1, 0}, {3 + 2 * little, -1, 1}}), ElementsAre(Passage{3, 3 + 2 * little, 0, 1}));
}

TEST(BrlcadPassages, UnorientedOddNumberLosesWhatWasLeftOfTheLastGroup) {
  EXPECT_THAT(unoriented({{1, 1, 0}, {2, 1, 1}, {2, 1, 2}, {4, 1, 3}}), ElementsAre(Passage{1, 4, 0, 3}));
  // An edge that the ray enters through, and a silhouette that it touches: the true way is 1 to 4.
  EXPECT_THAT(unoriented({{1, 1, 0}, {1, 1, 1}, {2, 1, 2}, {4, 1, 3}}), ElementsAre(Passage{2, 4, 2, 3}));
}

// ---- Oriented solids: below 0 a hit enters, above 0 it leaves.

std::vector<Passage> oriented(std::vector<Hit> hits) {
  return passages_of(solid_of(BagMode::solid, Orientation::ccw), std::move(hits));
}

TEST(BrlcadPassages, OrientedEntryAndExitMakeAPassage) {
  EXPECT_THAT(oriented({{1, -1, 0}, {2, 1, 1}, {4, -1, 2}, {8, 1, 3}}),
              ElementsAre(Passage{1, 2, 0, 1}, Passage{4, 8, 2, 3}));
}

TEST(BrlcadPassages, OrientedLoneFaceIsNeverHit) {
  EXPECT_THAT(oriented({{3, -1, 0}}), IsEmpty());
  EXPECT_THAT(oriented({{3, 1, 0}}), IsEmpty());
}

TEST(BrlcadPassages, OrientedHitWithoutSlopeIsBoth) {
  EXPECT_THAT(oriented({{3, 0, 0}}), ElementsAre(Passage{3, 3, 0, 0}));
  EXPECT_THAT(oriented({{3, nan, 0}}), ElementsAre(Passage{3, 3, 0, 0}));
  EXPECT_THAT(oriented({{1, -1, 0}, {2, 0, 1}, {4, 1, 2}}), ElementsAre(Passage{1, 2, 0, 1}, Passage{4, 4, 2, 2}));
}

TEST(BrlcadPassages, OrientedLeadingExitsAndTrailingEntriesAreDropped) {
  EXPECT_THAT(oriented({{1, 1, 0}, {2, -1, 1}, {4, 1, 2}, {8, -1, 3}}), ElementsAre(Passage{2, 4, 1, 2}));
  EXPECT_THAT(oriented({{1, 1, 0}, {2, -1, 1}}), IsEmpty());
}

// Not the first entry and the last exit, as its comment has it.
TEST(BrlcadPassages, OrientedLastOfEntriesAndFirstOfExitsCount) {
  EXPECT_THAT(oriented({{1, -1, 0}, {2, -1, 1}, {4, 1, 2}, {8, 1, 3}}), ElementsAre(Passage{2, 4, 1, 2}));
}

TEST(BrlcadPassages, OrientedEdgeIsOneHitTheLater) {
  EXPECT_THAT(oriented({{1, -1, 0}, {1, -1, 1}, {4, 1, 2}, {4, 1, 3}}), ElementsAre(Passage{1, 4, 1, 3}));
  // One that only touches: entry and exit.
  EXPECT_THAT(oriented({{3, -1, 0}, {3, 1, 1}}), ElementsAre(Passage{3, 3, 0, 1}));
  EXPECT_THAT(oriented({{3, 1, 0}, {3, -1, 1}}), IsEmpty());
}

TEST(BrlcadPassages, OrientedVertexIsOneHit) {
  EXPECT_THAT(oriented({{1, -1, 0}, {1, -1, 1}, {1, -1, 2}, {4, 1, 3}}), ElementsAre(Passage{1, 4, 0, 3}));
}

// Of four together, two of each: put in turn, and at the distance of what comes first then.
TEST(BrlcadPassages, OrientedHitsTogetherArePutInTurn) {
  constexpr double t = 1 + little / 2;
  EXPECT_THAT(oriented({{1, 1, 0}, {t, -1, 1}, {t, 1, 2}, {t, -1, 3}}),
              ElementsAre(Passage{t, t, 1, 0}, Passage{t, t, 3, 2}));
}

// Entry and exit in unequal number: the first exit that follows on the entry before, and the next entry.
TEST(BrlcadPassages, OrientedHitsTogetherAreThinnedOut) {
  EXPECT_THAT(oriented({{1, -1, 0}, {3, -1, 1}, {3, 1, 2}, {3, -1, 3}, {3, -1, 4}, {6, 1, 5}}),
              ElementsAre(Passage{1, 3, 0, 2}, Passage{3, 6, 3, 5}));
}

TEST(BrlcadPassages, NoHitsMakeNone) {
  for (const BagMode mode : {BagMode::surface, BagMode::solid, BagMode::plate})
    for (const Orientation orientation : {Orientation::none, Orientation::ccw})
      EXPECT_THAT(passages_of(solid_of(mode, orientation), {}), IsEmpty());
}

}  // namespace
}  // namespace plumbline::brlcad
