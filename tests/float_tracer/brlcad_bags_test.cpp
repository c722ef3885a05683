// BRL-CAD's tracers at bags of several faces: by hand, and as recorded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "case/float_bits.h"
#include "tests/float_tracer/brlcad_meshes.h"
#include "tests/float_tracer/recorded_bags.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

const Triangle flat{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};  // ab x ac = (0, 0, 4)
const Triangle point{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};

Triangle raised(Triangle t, double z) {
  t.a.z += z, t.b.z += z, t.c.z += z;
  return t;
}

// From height z straight down, one unit of length per unit of t.
Ray down(double x, double y, double z = 5) { return {.origin = {x, y, z}, .direction = {0, 0, -1}}; }

std::vector<Passage> passages(const std::string& tracer, const Bag& bag, const Ray& ray) {
  std::vector<Passage> found;
  EXPECT_TRUE(tracer_named(tracer).prepare(bag)->passages(ray, found));
  return found;
}

std::vector<std::pair<double, double>> ways(const std::string& tracer, const Bag& bag, const Ray& ray) {
  std::vector<std::pair<double, double>> ends;
  for (const Passage& p : passages(tracer, bag, ray)) ends.emplace_back(p.in, p.out);
  return ends;
}
using Way = std::pair<double, double>;

class BrlcadBags : public testing::TestWithParam<std::string> {
 protected:
  std::vector<Way> ways(const Bag& bag, const Ray& ray) { return plumbline::ways(GetParam(), bag, ray); }
};
INSTANTIATE_TEST_SUITE_P(All, BrlcadBags,
                         testing::Values("brlcad_bot_classic", "brlcad_bot_classic_kernel", "brlcad_bot_hlbvh"),
                         parameter_name);

TEST_P(BrlcadBags, ASurfaceIsHitAtEveryFace) {
  const Bag stack{.triangles = {raised(flat, -4), raised(flat, -2), flat}};
  EXPECT_THAT(passages(GetParam(), stack, down(0.5, 0.5)),
              ElementsAre(Passage{5, 5, 2, 2}, Passage{7, 7, 1, 1}, Passage{9, 9, 0, 0}));
  const Answer first = shoot(GetParam(), stack, down(0.5, 0.5));
  EXPECT_EQ(first.triangle, 2u);
  EXPECT_EQ(first.t, 5);
  EXPECT_TRUE(first.has_segment);
}

TEST_P(BrlcadBags, PlatesAreOneWhereTheyTouch) {
  Bag stack{.triangles = {flat, raised(flat, -2)}, .mode = BagMode::plate, .thickness = 1};
  EXPECT_THAT(ways(stack, down(0.5, 0.5)), ElementsAre(Way{4.5, 5.5}, Way{6.5, 7.5}));
  stack.thickness = 2;
  if (GetParam() == "brlcad_bot_classic_kernel")
    EXPECT_THAT(ways(stack, down(0.5, 0.5)), ElementsAre(Way{4, 6}, Way{6, 8}));
  else
    EXPECT_THAT(ways(stack, down(0.5, 0.5)), ElementsAre(Way{4, 8}));
}

// The cube from -1 to 1; the diagonals of its faces z = 1 and z = -1 cross over (0, 0).
TEST_P(BrlcadBags, ACubeIsEnteredAndLeft) {
  for (const Orientation orientation : {Orientation::none, Orientation::ccw}) {
    const Bag bag{.triangles = cube(), .mode = BagMode::solid, .orientation = orientation};
    EXPECT_THAT(ways(bag, down(0.5, 0.25)), ElementsAre(Way{4, 6}));
    EXPECT_THAT(ways(bag, down(0, 0)), ElementsAre(Way{4, 6})) << "through two edges";
    EXPECT_THAT(ways(bag, down(1.5, 0)), IsEmpty());
  }
}

TEST_P(BrlcadBags, ACubeOfTheOtherOrientationIsMissed) {
  EXPECT_THAT(ways({.triangles = cube(), .mode = BagMode::solid, .orientation = Orientation::cw}, down(0.5, 0.25)),
              IsEmpty());
}

// One of the two triangles of the lower face is missing: where the ray leaves there is nothing.
TEST_P(BrlcadBags, ASolidWithAHoleIsLostBehindIt) {
  Bag bag{.triangles = cube(), .mode = BagMode::solid, .orientation = Orientation::ccw};
  std::erase_if(bag.triangles, [](const Triangle& t) { return t.a.z == -1 && t.b.z == -1 && t.c.z == -1; });
  EXPECT_THAT(ways(bag, down(0.5, 0.25)), IsEmpty());
  bag.orientation = Orientation::none;
  EXPECT_THAT(ways(bag, down(0.5, 0.25)), ElementsAre(Way{4, 4}));
}

TEST_P(BrlcadBags, FacesAreDroppedOneByOne) {
  EXPECT_THAT(passages(GetParam(), {.triangles = {point, flat, point}}, down(0.5, 0.5)),
              ElementsAre(Passage{5, 5, 1, 1}));
  EXPECT_THAT(ways({.triangles = {point, point}}, down(0, 0)), IsEmpty());
}

TEST_P(BrlcadBags, TellNoPassagesWhereTheyHaveNoAnswer) {
  std::vector<Passage> found(3);
  EXPECT_FALSE(tracer_named(GetParam()).prepare({.triangles = {flat, flat}})->passages(down(not_a_number, 0), found));
  EXPECT_THAT(found, IsEmpty());
}

TEST_P(BrlcadBags, TellNoRejectionOfSeveralFaces) {
  EXPECT_EQ(tracer_named(GetParam()).prepare({.triangles = {flat, flat}})->rejection(down(9, 9)), Rejection::none);
}

// ---- Beyond 32 faces

std::vector<Triangle> stack_of(std::size_t count, double gap = 1) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < count; ++i) triangles.push_back(raised(flat, -gap * static_cast<double>(i)));
  return triangles;
}

TEST_P(BrlcadBags, ManyFacesAreAllHit) {
  for (const std::size_t count : {32u, 33u, 100u}) {
    const std::vector<Passage> found = passages(GetParam(), {.triangles = stack_of(count)}, down(0.5, 0.5));
    ASSERT_THAT(found, SizeIs(count));
    for (std::uint32_t i = 0; i < count; ++i) {
      EXPECT_EQ(found[i].triangle_in, i);
      EXPECT_NEAR(found[i].in, 5 + i, 1e-13);
    }
  }
}

// direction . (ab x ac) = 4 * 2^-31 = 1.9e-9 is enough, direction . normal = 2^-31 is not.
TEST(BrlcadClassic, InPiecesTheUnitNormalTellsWhatIsParallel) {
  const Ray grazing{.origin = {-0.5, 0.5, 0x1p-31}, .direction = {1, 0, -0x1p-31}};
  EXPECT_THAT(ways("brlcad_bot_classic", {.triangles = stack_of(32)}, grazing), SizeIs(1));
  EXPECT_THAT(ways("brlcad_bot_classic", {.triangles = stack_of(33)}, grazing), IsEmpty());
}

TEST(BrlcadClassic, HasNoAnswerWhereOnePieceIsLeftOfMany) {
  Bag bag{.triangles = {33, point}};
  std::fill_n(bag.triangles.begin(), 4, flat);
  EXPECT_EQ(shoot("brlcad_bot_classic", bag, down(0.5, 0.5)).outcome, Outcome::fault);
  EXPECT_EQ(shoot("brlcad_bot_hlbvh", bag, down(0.5, 0.5)).outcome, Outcome::hit);
  bag.triangles[4] = flat;
  EXPECT_EQ(shoot("brlcad_bot_classic", bag, down(0.5, 0.5)).outcome, Outcome::hit);
  bag.triangles.assign(33, point);
  EXPECT_EQ(shoot("brlcad_bot_classic", bag, down(0.5, 0.5)).outcome, Outcome::miss);
  bag.triangles.assign(32, point);
  bag.triangles[7] = flat;
  EXPECT_EQ(shoot("brlcad_bot_classic", bag, down(0.5, 0.5)).outcome, Outcome::hit);
}

// The step of 0.0005 lengths is lost in the parameter 2 / 2^-47.
TEST(BrlcadClassic, HasNoAnswerWhereTheWalkNeverEnds) {
  const Ray creeping{.origin = {0.5, 0.5, -5.5}, .direction = {0x1p-47, 0, 0}};
  EXPECT_EQ(shoot("brlcad_bot_classic", {.triangles = stack_of(33)}, creeping).outcome, Outcome::fault);
  EXPECT_EQ(shoot("brlcad_bot_classic", {.triangles = stack_of(32)}, creeping).outcome, Outcome::miss);
}

// Without pieces nothing that is more than 2 behind the origin is looked at by the walk, but the faces are hit from the
// moved origin in both directions; in pieces the walk begins where the solid does.
TEST(BrlcadClassic, FromWithinBothLookBackToTheEntry) {
  for (const int depth : {0, 1, 2}) {
    std::vector<Triangle> sphere = icosphere(depth);
    for (Triangle& t : sphere)
      for (Vec3* v : {&t.a, &t.b, &t.c}) *v = {16 * v->x, 16 * v->y, 16 * v->z};
    const auto found = ways("brlcad_bot_classic", {.triangles = sphere, .mode = BagMode::solid},
                            {.origin = {0.5, 0.25, 0.125}, .direction = {0, 0, 1}});
    ASSERT_THAT(found, SizeIs(1)) << depth;
    EXPECT_LT(found[0].first, -10);
    EXPECT_GT(found[0].second, 10);
  }
}

// Eight faces are two leaves: the squares left of x = 2 and those right of it. The plane between them is an upper face
// of the one, which loses the ray, and a lower one of the other, which keeps it.
TEST(BrlcadHlbvh, LosesRaysInUpperFacesOfLeavesWithinTheObject) {
  std::vector<Triangle> strip;
  for (int i = 0; i < 4; ++i) {
    const double x = i;
    strip.push_back({{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}});
    strip.push_back({{x, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}});
  }
  const auto hit = [&](const char* tracer, double x) {
    std::set<std::uint32_t> triangles;
    Bag bag{.triangles = strip, .mode = BagMode::plate, .thickness = 0.5};
    for (const Passage& p : passages(tracer, bag, down(x, 0.5))) triangles.insert(p.triangle_in);
    return triangles.size();
  };
  EXPECT_EQ(hit("brlcad_bot_classic", 2), 1u);
  EXPECT_EQ(hit("brlcad_bot_hlbvh", 2), 1u);
  EXPECT_EQ(hit("brlcad_bot_classic", 4), 1u);
  EXPECT_EQ(hit("brlcad_bot_hlbvh", 4), 0u);
}

// ---- As recorded

testing::AssertionResult equal(const std::vector<Passage>& found, const std::vector<Passage>& recorded) {
  const bool same = std::ranges::equal(found, recorded, [](const Passage& x, const Passage& y) {
    return to_bits(x.in) == to_bits(y.in) && to_bits(x.out) == to_bits(y.out) && x.triangle_in == y.triangle_in &&
           x.triangle_out == y.triangle_out;
  });
  if (same) return testing::AssertionSuccess();
  auto failure = testing::AssertionFailure();
  for (const Passage& p : recorded) failure << "\n  recorded " << p.in << " " << p.out << " " << p.triangle_in;
  for (const Passage& p : found) failure << "\n  answered " << p.in << " " << p.out << " " << p.triangle_in;
  return failure;
}

TEST(RecordedBags, AreAnsweredBitForBit) {
  std::size_t rays = 0, partitions = 0;
  std::set<std::string> meshes;
  for (const RecordedBag& recorded : read_recorded_bags(recorded_bags_file())) {
    meshes.insert(recorded.mesh);
    const auto bag = tracer_named("brlcad_bot_classic").prepare(recorded.bag);
    for (const RecordedShot& shot : recorded.shots) {
      std::vector<Passage> found;
      EXPECT_TRUE(bag->passages(shot.ray, found));
      EXPECT_TRUE(equal(found, shot.passages)) << recorded.mesh << ", " << name(recorded.bag.mode) << ", "
                                               << name(recorded.bag.orientation) << ", ray " << shot.ray.origin.x;
      ++rays;
      partitions += shot.passages.size();
    }
  }
  EXPECT_EQ(meshes.size(), 11u);
  EXPECT_EQ(rays, 968u);
  EXPECT_EQ(partitions, 2833u);
}

}  // namespace
}  // namespace plumbline
