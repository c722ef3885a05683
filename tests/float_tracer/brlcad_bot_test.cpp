// BRL-CAD's tracers whole, on cases derived by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "case/lattice.h"
#include "case/targets.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

using testing::ElementsAre;

const Triangle flat{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};  // ab x ac = (0, 0, 4); model box [0,2] x [0,2] x [-1,1]

Bag surface(const Triangle& triangle) { return {.triangles = {triangle}}; }

Bag plate(double thickness) { return {.triangles = {flat}, .mode = BagMode::plate, .thickness = thickness}; }

// From height z straight down, two units of length per unit of t.
Ray down(double x, double y, double z = 5) { return {.origin = {x, y, z}, .direction = {0, 0, -2}}; }

class Brlcad : public testing::TestWithParam<std::string> {
 protected:
  Answer shoot_at(const Bag& bag, const Ray& ray) { return shoot(GetParam(), bag, ray); }
};
INSTANTIATE_TEST_SUITE_P(All, Brlcad,
                         testing::Values("brlcad_bot_classic", "brlcad_bot_classic_kernel", "brlcad_bot_hlbvh"),
                         parameter_name);

// The walk moves the origin to z = 5 - 2 * 2.0005, rounded; the way back adds up to 2.5 again exactly, because
// every difference of numbers this near each other is exact.
TEST_P(Brlcad, SurfaceReportsTheHitAsInOutAndT) {
  const Answer answer = shoot_at(surface(flat), down(0.5, 0.5));
  ASSERT_EQ(answer.outcome, Outcome::hit);
  EXPECT_TRUE(answer.has_segment && answer.has_t && !answer.has_uv);
  EXPECT_EQ(answer.in, 0x1.4p+1);
  EXPECT_EQ(answer.out, 0x1.4p+1);
  EXPECT_EQ(answer.t, 0x1.4p+1);
}

TEST_P(Brlcad, PlateReportsInAndOutButNotTheHitBetween) {
  const Answer answer = shoot_at(plate(0.5), down(0.5, 0.5));
  ASSERT_EQ(answer.outcome, Outcome::hit);
  EXPECT_TRUE(answer.has_segment && !answer.has_t && !answer.has_uv);
  EXPECT_EQ(answer.in, 0x1.3p+1);   // 2.5 - 0.5/2/2
  EXPECT_EQ(answer.out, 0x1.5p+1);  // 2.5 + 0.5/2/2
}

TEST_P(Brlcad, AppendedPlateBeginsAtTheFace) {
  Bag bag = plate(0.5);
  bag.position = PlatePosition::appended;
  const Answer answer = shoot_at(bag, down(0.5, 0.5));
  EXPECT_EQ(answer.in, 0x1.4p+1);
  EXPECT_EQ(answer.out, 0x1.6p+1);
}

TEST_P(Brlcad, PlateWithoutCosineIsAsThickInTheParameter) {
  Bag bag = plate(0.5);
  bag.cosine = false;
  const Answer answer = shoot_at(bag, down(0.5, 0.5));
  EXPECT_EQ(answer.in, 0x1.2p+1);
  EXPECT_EQ(answer.out, 0x1.6p+1);
}

TEST_P(Brlcad, EdgesOfTheTriangleBelongToIt) {
  EXPECT_EQ(shoot_at(surface(flat), down(0, 0)).outcome, Outcome::hit);
  EXPECT_EQ(shoot_at(surface(flat), down(1, 0)).outcome, Outcome::hit);
  EXPECT_EQ(shoot_at(surface(flat), down(0, 1)).outcome, Outcome::hit);
  EXPECT_EQ(shoot_at(surface(flat), down(1, 1)).outcome, Outcome::hit);
  EXPECT_EQ(shoot_at(surface(flat), down(1 + 0x1p-20, 1)).outcome, Outcome::miss);
  EXPECT_EQ(shoot_at(surface(flat), down(-0x1p-20, 1)).outcome, Outcome::miss);
  EXPECT_EQ(shoot_at(surface(flat), down(1, -0x1p-20)).outcome, Outcome::miss);
}

TEST_P(Brlcad, VertexOrderAndOrientationChangeNothing) {
  const auto& [a, b, c] = flat;
  for (const Triangle& t : {Triangle{a, b, c}, {a, c, b}, {b, a, c}, {b, c, a}, {c, a, b}, {c, b, a}})
    for (const Orientation orientation : {Orientation::none, Orientation::ccw, Orientation::cw}) {
      Bag bag = surface(t);
      bag.orientation = orientation;
      EXPECT_EQ(shoot_at(bag, down(0.5, 0.25)).t, 2.5);
      EXPECT_EQ(shoot_at(bag, down(1.5, 1)).outcome, Outcome::miss);
    }
}

TEST_P(Brlcad, UnorientedSolidIsHitByALoneFaceAnOrientedOneNever) {
  Bag bag = surface(flat);
  bag.mode = BagMode::solid;
  EXPECT_EQ(shoot_at(bag, down(0.5, 0.5)).t, 2.5);
  for (const Orientation orientation : {Orientation::ccw, Orientation::cw}) {
    bag.orientation = orientation;
    EXPECT_EQ(shoot_at(bag, down(0.5, 0.5)).outcome, Outcome::miss);
    EXPECT_EQ(shoot_at(bag, {.origin = {0.5, 0.5, -5}, .direction = {0, 0, 2}}).outcome, Outcome::miss);
  }
}

TEST_P(Brlcad, FaceOfSmallAreaIsNotThere) {
  const double leg = 0x1p-6;  // see BrlcadSolid.DropsAFaceOfSmallAreaHoweverLongItsEdges
  EXPECT_EQ(shoot_at(surface({{0, 0, 0}, {leg, 0, 0}, {0, leg, 0}}), down(leg / 4, leg / 4)).outcome, Outcome::miss);
  EXPECT_EQ(shoot_at(surface({{0, 0, 0}, {2 * leg, 0, 0}, {0, 2 * leg, 0}}), down(leg / 4, leg / 4)).outcome,
            Outcome::hit);
}

// direction . (ab x ac) = 4 * 2^-32 = 0.93e-9 is taken for parallel, twice that is not. The ray meets (0.5, 0.5, 0)
// at 1.
TEST_P(Brlcad, GrazingRaysAreTakenForParallel) {
  const auto grazing = [](double slope) { return Ray{.origin = {-0.5, 0.5, slope}, .direction = {1, 0, -slope}}; };
  EXPECT_EQ(shoot_at(surface(flat), grazing(0x1p-32)).outcome, Outcome::miss);
  EXPECT_EQ(shoot_at(surface(flat), grazing(0x1p-31)).outcome, Outcome::hit);
}

TEST_P(Brlcad, DoesNotReadTheRange) {
  Ray ray = down(0.5, 0.5);
  ray.t_max = 1;
  EXPECT_EQ(shoot_at(surface(flat), ray).t, 2.5);
  ray.t_min = 3, ray.t_max = not_a_number;
  EXPECT_EQ(shoot_at(surface(flat), ray).t, 2.5);
}

TEST_P(Brlcad, ABagWithoutTrianglesIsMissed) { EXPECT_EQ(shoot_at({}, down(0.5, 0.5)).outcome, Outcome::miss); }

TEST_P(Brlcad, FaultsOnWhatIsNotFinite) {
  for (const double bad : {not_a_number, infinity, -infinity}) {
    for (std::size_t i = 0; i < 9; ++i) {
      Triangle spoilt = flat;
      *coordinates(spoilt)[i] = bad;
      EXPECT_EQ(shoot_at(surface(spoilt), down(0.5, 0.5)).outcome, Outcome::fault);
    }
    for (std::size_t i = 0; i < 6; ++i) {
      Ray spoilt = down(0.5, 0.5);
      *coordinates(spoilt)[i] = bad;
      EXPECT_EQ(shoot_at(surface(flat), spoilt).outcome, Outcome::fault);
    }
    EXPECT_EQ(shoot_at(plate(bad), down(0.5, 0.5)).outcome, Outcome::fault);
  }
}

// A ray through the interior next to vertex a, across the corner of the model's box: it hits (s, s, 0) at t = 1 and its
// way through the box is 2s long. Shorter than 0.0005, and the walk has left the box before it tests a triangle.
TEST(BrlcadNudge, LosesAHitSquareInTheTriangle) {
  const auto across_the_corner = [](double s) { return Ray{.origin = {s + 1, s - 1, 1}, .direction = {-1, 1, -1}}; };
  for (const char* walking : {"brlcad_bot_classic", "brlcad_bot_hlbvh"}) {
    EXPECT_EQ(shoot(walking, surface(flat), across_the_corner(0x1p-13)).outcome, Outcome::miss) << walking;
    EXPECT_EQ(shoot(walking, surface(flat), across_the_corner(0x1p-11)).outcome, Outcome::hit) << walking;
  }
  EXPECT_EQ(shoot("brlcad_bot_classic_kernel", surface(flat), across_the_corner(0x1p-13)).t, 1);
}

// The same triangle moved off the whole numbers: its box has room, and nothing is lost.
TEST(BrlcadNudge, DependsOnWhereTheModelStands) {
  const double s = 0x1p-13, shift = 0.25;
  const Triangle moved{{shift, shift, 0}, {2 + shift, shift, 0}, {shift, 2 + shift, 0}};
  const Ray ray{.origin = {s + 1 + shift, s - 1 + shift, 1}, .direction = {-1, 1, -1}};
  EXPECT_EQ(shoot("brlcad_bot_classic", surface(moved), ray).outcome, Outcome::hit);
}

TEST(BrlcadOrigin, HitsWithinTheToleranceOfTheOriginAreLost) {
  EXPECT_EQ(shoot("brlcad_bot_classic", surface(flat), down(0.5, 0.5, 0)).outcome, Outcome::miss);
  EXPECT_EQ(shoot("brlcad_bot_classic", surface(flat), down(0.5, 0.5, 0x1p-10)).outcome,
            Outcome::miss);                                                                             // t = 0.000488
  EXPECT_EQ(shoot("brlcad_bot_classic", surface(flat), down(0.5, 0.5, 0x1p-9)).outcome, Outcome::hit);  // t = 0.000977
}

TEST(BrlcadOrigin, InsideAPlateTheEntryIsBehind) {
  // A quarter below the middle of a plate one thick: in 0.5/2 + 0.25/2 back, out 0.5/2 - 0.25/2 ahead.
  const Answer answer = shoot("brlcad_bot_classic", plate(1), down(0.5, 0.5, -0.25));
  ASSERT_EQ(answer.outcome, Outcome::hit);
  EXPECT_EQ(answer.in, -0.375);
  EXPECT_EQ(answer.out, 0.125);
  EXPECT_EQ(shoot("brlcad_bot_classic", plate(0.25), down(0.5, 0.5, -0.25)).outcome, Outcome::miss);
}

TEST(BrlcadOrigin, TheTriangleTestAloneTakesTheWholeLine) {
  EXPECT_EQ(shoot("brlcad_bot_classic_kernel", surface(flat), down(0.5, 0.5, -8)).t, -4);
  EXPECT_EQ(shoot("brlcad_bot_classic", surface(flat), down(0.5, 0.5, -8)).outcome, Outcome::miss);
}

TEST(BrlcadOverflow, ABoxWithoutASizeIsAFault) {
  const double most = 0x1p+1023;
  EXPECT_EQ(shoot("brlcad_bot_classic", surface({{-most, 0, 0}, {most, 0, 0}, {0, 2, 0}}), down(0.5, 0.5)).outcome,
            Outcome::fault);
  EXPECT_NE(shoot("brlcad_bot_classic", surface({{0, 0, 0}, {most, 0, 0}, {0, 2, 0}}), down(0.5, 0.5)).outcome,
            Outcome::fault);
}

// Coordinates so large that products overflow: the test's own numbers are NaN, of which no comparison is true, so
// nothing rejects the hit; its t overflows as well. The unit normal is zero, so that the lone face is kept. A
// real 7.24.2 says the same.
TEST(BrlcadOverflow, NaNPassesTheTriangleTest) {
  const Bag bag{.triangles = {{{0x1.097d98f867a21p-112, 0x1.5313f284b04b8p-76, -0x1.1ce6a66ea1e42p-455},
                               {-0x1.50b0965eac749p+343, 0x1.848442084e081p+523, 0x1.d14fda9fc33b4p+722},
                               {-0x1.adad6bca253acp-782, -0x1.1670cadd5d806p+221, -0x1.c2938d62e702ap-340}}},
                .mode = BagMode::solid,
                .orientation = Orientation::ccw};
  const Ray ray{.origin = {-0x1.25333c4ad58d7p-759, 0x1.f84a22a29a821p-541, 0x1.47f51eef7696ep+688},
                .direction = {-0x1.ca56965327fb8p-81, 0x1.3a1749db0a0ecp+19, -0x1.4fa60c34c2969p+128}};
  const Answer answer = shoot("brlcad_bot_classic", bag, ray);
  EXPECT_EQ(answer.outcome, Outcome::hit);
  EXPECT_EQ(answer.in, infinity);
  EXPECT_EQ(answer.out, infinity);
}

// A real 7.24.2 takes this for a defective segment, and drops it.
TEST(BrlcadOverflow, ANaNForTIsAMiss) {
  const Triangle triangle{{-0x1.8627d6f10fbe2p+418, 0x1.9c5015f2aeap+194, 0x1.10464ea965b42p-176},
                          {-0x1.b1c03fa25db48p-69, -0x1.2f9f4892fbb84p+137, 0x1.3f59f8ba123acp+179},
                          {0x1.57d9ce1d21235p+493, 0x1.71c10a9856fb4p+432, 0x1.733c5a5a31aecp+176}};
  const Ray ray{.origin = {0x1.cec97d9afce38p-484, -0x1.0836e01f9ef41p-493, -0x1.1e46e2d77ffe8p+394},
                .direction = {0x1.711c1925cd08dp-494, 0x1.e666462c0b0ffp-192, 0x1.4b52e8fb3bfe9p+339}};
  EXPECT_EQ(shoot("brlcad_bot_classic", surface(triangle), ray).outcome, Outcome::miss);
}

// A ray along an axis in an upper face of the box leaves it, as the box test sees it, before it has entered.
TEST(BrlcadHlbvh, LosesAxisRaysInAnUpperFaceOfTheBox) {
  const Bag bag = surface({{0, 0, 0}, {1.5, 0, 0}, {0, 1.5, 0}});
  const auto outcome = [&](const char* tracer, double x, double y) {
    return shoot(tracer, bag, {.origin = {x, y, 5}, .direction = {0, 0, -1}}).outcome;
  };
  EXPECT_EQ(outcome("brlcad_bot_hlbvh", 1.5, 0), Outcome::miss);
  EXPECT_EQ(outcome("brlcad_bot_hlbvh", 0, 1.5), Outcome::miss);
  EXPECT_EQ(outcome("brlcad_bot_hlbvh", 0, 0), Outcome::hit);
  EXPECT_EQ(outcome("brlcad_bot_hlbvh", 0.75, 0), Outcome::hit);
  EXPECT_EQ(outcome("brlcad_bot_hlbvh", 0, 0.75), Outcome::hit);
  for (const auto& [x, y] : {std::pair{1.5, 0.0}, {0.0, 1.5}, {0.0, 0.0}, {0.75, 0.0}, {0.0, 0.75}})
    EXPECT_EQ(outcome("brlcad_bot_classic", x, y), Outcome::hit) << x << " " << y;
}

// The report's table: for interior, vertex and edge, and each tolerance, how many answers are as wished.
std::array<int, 5> report_successes(const char* tracer) {
  const Decimal box = parse_decimal("2", "box"), step = parse_decimal("1.5", "step");
  const LatticeAxis axis{.box = box, .step = step, .offset = {}};
  const Lattice lattice = make_lattice({axis, axis, axis});
  const std::vector<Aim> aimed = aims({});
  std::vector<Ray> rays(aimed.size());
  std::vector<Answer> answers(aimed.size());
  std::array<int, 5> successes{};
  for (std::uint64_t i = 0; i < triple_count(lattice); ++i) {
    const LatticeTriple triple = triple_at(lattice, i);
    if (collinear(triple)) continue;
    const Triangle triangle = triangle_of(lattice, triple);
    aim_rays(triangle, {}, rays);
    tracer_named(tracer).prepare(surface(triangle))->trace(rays, answers);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const double tolerance = aimed[k].tolerance.value_or(0);
      const std::size_t row = aimed[k].target == TargetKind::interior      ? 0
                              : aimed[k].target == TargetKind::vertex_edge ? 1
                              : tolerance == 0.1                           ? 2
                              : tolerance == 0.001                         ? 3
                                                                           : 4;
      successes[row] += (answers[k].outcome == Outcome::hit) == (aimed[k].wish == Wish::hit);
    }
  }
  return successes;
}

// The first row is the report's own; the second was measured with the real function of the newer release under the
// older walk.
TEST(BrlcadReport, SuccessesAreThoseOfTheRealThing) {
  EXPECT_THAT(report_successes("brlcad_bot_classic"), ElementsAre(1344, 1710, 5802, 5772, 5528));
  EXPECT_THAT(report_successes("brlcad_bot_hlbvh"), ElementsAre(1344, 846, 5490, 5184, 5280));
}

}  // namespace
}  // namespace plumbline
