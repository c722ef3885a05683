// By which of its tests a tracer says it missed: by hand, test by test, and that it says so exactly where it misses.
#include "float_tracer/rejection.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "float_tracer/float_environment.h"
#include "float_tracer/isolated.h"
#include "float_tracer/kernel.h"
#include "float_tracer/kernel_tracer.h"
#include "float_tracer/moller_trumbore.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {

void PrintTo(Rejection r, std::ostream* out) { *out << name(r); }

namespace {

static_assert(name(Rejection::none) == "none" && name(Rejection::segment) == "segment");

const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

Ray down(double x, double y) { return {.origin = {x, y, 8}, .direction = {0, 0, -2}}; }
Ray up(double x, double y) { return {.origin = {x, y, -8}, .direction = {0, 0, 2}}; }

Rejection rejection(std::string_view tracer, const Bag& bag, const Ray& ray) {
  return tracer_named(tracer).prepare(bag)->rejection(ray);
}

class KernelRejection : public testing::TestWithParam<std::string> {
 protected:
  Rejection of(const Triangle& triangle, const Ray& ray) {
    return rejection(GetParam(), {.triangles = {triangle}}, ray);
  }
  bool is(std::string_view kernel) const { return GetParam().starts_with(kernel); }
};
INSTANTIATE_TEST_SUITE_P(All, KernelRejection,
                         testing::Values("moller_trumbore_f32", "moller_trumbore_f64", "woop_watertight_f32",
                                         "woop_watertight_f64", "plucker_f32", "plucker_f64", "baldwin_weber_f32",
                                         "baldwin_weber_f64"),
                         parameter_name);

TEST_P(KernelRejection, NoneWhereItHits) {
  for (const auto& [x, y] : {std::pair{1.0, 1.0}, {0.0, 0.0}, {4.0, 0.0}, {0.0, 4.0}, {2.0, 2.0}})
    EXPECT_EQ(of(flat, down(x, y)), Rejection::none) << x << " " << y;
}

TEST_P(KernelRejection, NamesTheEdgeThatTheRayPassesOutside) {
  const double step = 0x1p-12;
  for (const auto& ray : {down, up}) {
    for (const double along : {step, 2.0, 4 - 2 * step}) {
      EXPECT_EQ(of(flat, ray(along, -step)), Rejection::ab) << along;
      EXPECT_EQ(of(flat, ray(-step, along)), Rejection::ca) << along;
      EXPECT_EQ(of(flat, ray(along + step, 4 - along)), Rejection::bc) << along;
    }
    EXPECT_EQ(of(flat, ray(8, 1)), Rejection::bc);
    EXPECT_EQ(of(flat, ray(1, 8)), Rejection::bc);
    // On the line of an edge, beyond its end: that number is zero and belongs to both sides.
    EXPECT_EQ(of(flat, ray(8, 0)), Rejection::bc);
    EXPECT_EQ(of(flat, ray(0, 8)), Rejection::bc);
    EXPECT_EQ(of(flat, ray(-1, 0)), Rejection::ca);
    EXPECT_EQ(of(flat, ray(0, -1)), Rejection::ab);
  }
}

TEST_P(KernelRejection, FollowsTheVertexOrder) {
  const auto& [a, b, c] = flat;
  const Ray beyond_x_axis = down(2, -0.5);
  EXPECT_EQ(of({a, b, c}, beyond_x_axis), Rejection::ab);
  EXPECT_EQ(of({b, a, c}, beyond_x_axis), Rejection::ab);
  EXPECT_EQ(of({c, a, b}, beyond_x_axis), Rejection::bc);
  EXPECT_EQ(of({c, b, a}, beyond_x_axis), Rejection::bc);
  EXPECT_EQ(of({a, c, b}, beyond_x_axis), Rejection::ca);
  EXPECT_EQ(of({b, c, a}, beyond_x_axis), Rejection::ca);
}

// Beyond a vertex the ray is outside by two edges.
TEST_P(KernelRejection, NamesTheFirstOfTwoInTheKernelsOwnOrder) {
  const bool by_signs = is("woop") || is("plucker");
  EXPECT_EQ(of(flat, down(-1, -1)), Rejection::ca);                                       // ca and ab
  EXPECT_EQ(of(flat, down(6, -1)), is("baldwin_weber") ? Rejection::ab : Rejection::bc);  // bc and ab
  EXPECT_EQ(of(flat, down(-1, 6)), by_signs ? Rejection::bc : Rejection::ca);             // bc and ca
}

TEST_P(KernelRejection, Range) {
  Ray ray = down(1, 1);
  ray.t_max = 3;
  EXPECT_EQ(of(flat, ray), Rejection::t);
  ray.t_min = 5, ray.t_max = infinity;
  EXPECT_EQ(of(flat, ray), Rejection::t);
  ray.t_min = not_a_number;
  EXPECT_EQ(of(flat, ray), Rejection::t);
}

// Baldwin and Weber divide by zero: t is a NaN.
TEST_P(KernelRejection, Parallel) {
  const Rejection expected = is("baldwin_weber") ? Rejection::t : Rejection::parallel;
  EXPECT_EQ(of(flat, {.origin = {-1, 1, 0}, .direction = {1, 0, 0}}), expected);
  EXPECT_EQ(of({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, down(1, 1)), expected);
}

TEST_P(KernelRejection, NaNsAreNamedToo) {
  Triangle spoilt = flat;
  spoilt.c.x = not_a_number;
  EXPECT_NE(of(spoilt, down(1, 1)), Rejection::none);
}

TEST_P(KernelRejection, NoneOfABagOfSeveral) {
  EXPECT_EQ(rejection(GetParam(), {}, down(9, 9)), Rejection::none);
  EXPECT_EQ(rejection(GetParam(), {.triangles = {flat, flat}}, down(9, 9)), Rejection::none);
}

// See Plucker.RejectsAParallelRayThatPassesItsEdgesOnOneSide.
TEST(Rejection, PluckersSlopeOfZeroIsParallel) {
  const Triangle far{{-57388, 17063, 27235}, {-57385, 17067, 27238}, {-57395, 17071, 27240}};
  const Ray ray{.origin = {-57386, 17066, 27236}, .direction = {-3, -4, -3}};
  EXPECT_EQ(rejection("plucker_f32", {.triangles = {far}}, ray), Rejection::parallel);
}

TEST(Rejection, OfSignsTheFirstThatIsAgainstTheirSum) {
  EXPECT_EQ(edge_against(-1.0, 2.0, 2.0), Rejection::bc);
  EXPECT_EQ(edge_against(2.0, -1.0, 2.0), Rejection::ca);
  EXPECT_EQ(edge_against(2.0, 2.0, -1.0), Rejection::ab);
  EXPECT_EQ(edge_against(1.0, -2.0, -2.0), Rejection::bc);
  EXPECT_EQ(edge_against(-2.0, 1.0, -2.0), Rejection::ca);
  EXPECT_EQ(edge_against(-2.0, -2.0, 1.0), Rejection::ab);
  // Two against the sum: beyond a vertex.
  EXPECT_EQ(edge_against(-1.0, -1.0, 4.0), Rejection::bc);
  EXPECT_EQ(edge_against(4.0, -1.0, -1.0), Rejection::ca);
  EXPECT_EQ(edge_against(1.0, -4.0, 1.0), Rejection::bc);
  EXPECT_EQ(edge_against(-4.0, 1.0, 1.0), Rejection::ca);
  // Zeros of either sign are with it; a sum of zero is positive.
  EXPECT_EQ(edge_against(0.0, 1.0, -2.0), Rejection::ca);
  EXPECT_EQ(edge_against(-0.0, 2.0, -1.0), Rejection::ab);
  EXPECT_EQ(edge_against(1.0, -1.0, 0.0), Rejection::ca);
  EXPECT_EQ(edge_against(-1.0, 0.0, 1.0), Rejection::bc);
  EXPECT_EQ(edge_against(0.0, -0.0, 0.0), Rejection::parallel);
  // NaNs are against anything.
  EXPECT_EQ(edge_against(not_a_number, 1.0, 1.0), Rejection::bc);
  EXPECT_EQ(edge_against(1.0, not_a_number, 1.0), Rejection::ca);
  EXPECT_EQ(edge_against(1.0, 1.0, not_a_number), Rejection::ab);
}

// A triangle as BRL-CAD's tests have it: model box [0,2] x [0,2] x [-1,1], ab x ac = (0, 0, 4).
const Triangle two{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};

class BrlcadRejection : public testing::TestWithParam<std::string> {
 protected:
  Rejection of(const Bag& bag, const Ray& ray) { return rejection(GetParam(), bag, ray); }
  Rejection of(const Triangle& triangle, const Ray& ray) { return of(Bag{.triangles = {triangle}}, ray); }
  bool walks() const { return GetParam() != "brlcad_bot_classic_kernel"; }
};
INSTANTIATE_TEST_SUITE_P(All, BrlcadRejection,
                         testing::Values("brlcad_bot_classic", "brlcad_bot_classic_kernel", "brlcad_bot_hlbvh"),
                         parameter_name);

TEST_P(BrlcadRejection, NoneWhereItHitsOrCannotAnswer) {
  EXPECT_EQ(of(two, down(0.5, 0.5)), Rejection::none);
  EXPECT_EQ(of(two, down(1, 1)), Rejection::none);
  EXPECT_EQ(of(two, down(not_a_number, 1)), Rejection::none);
  EXPECT_EQ(of(Bag{.triangles = {two, two}}, down(5, 5)), Rejection::none);
}

TEST_P(BrlcadRejection, DroppedFace) {
  EXPECT_EQ(of({{0, 0, 0}, {0x1p-6, 0, 0}, {0, 0x1p-6, 0}}, down(0x1p-8, 0x1p-8)), Rejection::face);
}

TEST_P(BrlcadRejection, Parallel) {
  EXPECT_EQ(of(two, {.origin = {-0.5, 0.5, 0x1p-32}, .direction = {1, 0, -0x1p-32}}), Rejection::parallel);
}

// Off the walls of the triangle's own box, which the hierarchy tests.
TEST_P(BrlcadRejection, Edges) {
  const bool boxed = GetParam() == "brlcad_bot_hlbvh";
  EXPECT_EQ(of(two, down(1.25, 1.25)), Rejection::bc);
  EXPECT_EQ(of({two.a, two.c, two.b}, down(1.25, 1.25)), Rejection::bc);
  EXPECT_EQ(of({two.c, two.a, two.b}, down(1.25, 1.25)), Rejection::ca);
  EXPECT_EQ(of({two.b, two.c, two.a}, down(1.25, 1.25)), Rejection::ab);
  const Triangle within{{0.25, 0.25, 0}, {1.25, 0.25, 0}, {0.25, 1.25, 0}};  // in a model box of [0,2] x [0,2]
  EXPECT_EQ(of(within, down(0.5, 0.125)), boxed ? Rejection::box : Rejection::ab);
  EXPECT_EQ(of(within, down(0.125, 0.5)), boxed ? Rejection::box : Rejection::ca);
  EXPECT_EQ(of(within, down(1.5, 0.5)), boxed ? Rejection::box : Rejection::bc);  // alpha alone
  EXPECT_EQ(of(within, down(0.5, 1.5)), boxed ? Rejection::box : Rejection::bc);  // beta alone
}

TEST_P(BrlcadRejection, BoxAndNudge) {
  EXPECT_EQ(of(two, down(3, 0.5)), walks() ? Rejection::box : Rejection::bc);
  // See BrlcadNudge.LosesAHitSquareInTheTriangle.
  const double s = 0x1p-13;
  const Ray across_the_corner{.origin = {s + 1, s - 1, 1}, .direction = {-1, 1, -1}};
  EXPECT_EQ(of(two, across_the_corner), walks() ? Rejection::nudge : Rejection::none);
}

TEST_P(BrlcadRejection, Range) {
  const Ray from_the_face{.origin = {0.5, 0.5, 0}, .direction = {0, 0, -1}};
  EXPECT_EQ(of(two, from_the_face), walks() ? Rejection::t : Rejection::none);
}

TEST_P(BrlcadRejection, SegmentWithoutItsOtherEnd) {
  const Bag solid{.triangles = {two}, .mode = BagMode::solid, .orientation = Orientation::ccw};
  EXPECT_EQ(of(solid, down(0.5, 0.5)), Rejection::segment);
}

// det = 2^-127 is subnormal in binary32, and flushed to zero.
TEST(Rejection, OfAFlushedKernelIsUnderItsOwnControls) {
  const double s = 0x1p-64;
  const Bag bag{.triangles = {{{0, 0, 0}, {s, 0, 0}, {0, 2 * s, 0}}}};
  const Ray ray{.origin = {s / 4, s / 4, 1}, .direction = {0, 0, -1}};
  const FloatEnvironment before;
  EXPECT_EQ(rejection("moller_trumbore_f32", bag, ray), Rejection::none);
  EXPECT_EQ(rejection("moller_trumbore_f32_ftz_daz", bag, ray), Rejection::parallel);
  EXPECT_FALSE(before.restore()) << "the controls stayed as they were";
}

TEST(Rejection, IsNotToldFromAChild) {
  const auto in_child = isolated(std::make_unique<KernelTracer<MollerTrumbore<double>>>());
  EXPECT_EQ(in_child->prepare({.triangles = {flat}})->rejection(down(9, 9)), Rejection::none);
}

// Rays at points of the edges, some of them moved, cut short or turned into the plane; all binary32.
TEST(Rejection, IsToldOfEveryMissAndOfNothingElse) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  for (const auto& tracer : listed_tracers()) {
    const std::string& name = tracer->info().name;
    if (!tracer->info().package.empty()) continue;
    const bool brlcad = name.starts_with("brlcad");
    std::mt19937_64 random(seed);
    const auto uniform = [&] { return static_cast<float>(random() >> 40) * 0x1p-23f - 1; };
    const auto point = [&] { return Vec3{uniform(), uniform(), uniform()}; };
    std::map<Rejection, int> counts;
    for (int i = 0; i < 20000; ++i) {
      const Triangle t{point(), point(), point()};
      const float u = static_cast<float>(random() % 5) / 4, v = static_cast<float>(random() % 5) / 4;
      const Vec3 o = point();
      const auto towards = [&](double a, double b, double c, double from) {
        return static_cast<float>(a + u * (b - a) + v * (c - a) - from);
      };
      Ray ray{.origin = o,
              .direction = {towards(t.a.x, t.b.x, t.c.x, o.x), towards(t.a.y, t.b.y, t.c.y, o.y),
                            towards(t.a.z, t.b.z, t.c.z, o.z)}};
      if (random() % 8 == 0) ray.t_max = 1;
      if (random() % 8 == 0) ray.direction = {t.b.x - t.a.x, t.b.y - t.a.y, t.b.z - t.a.z};
      const Bag bag{.triangles = {t}};
      const Answer answer = shoot(*tracer, bag, ray);
      const Rejection why = tracer->prepare(bag)->rejection(ray);
      ASSERT_EQ(why == Rejection::none, answer.outcome != Outcome::miss)
          << name << " " << i << " " << plumbline::name(why);
      ++counts[why];
    }
    for (const Rejection each : {Rejection::none, Rejection::ab, Rejection::bc, Rejection::ca})
      EXPECT_GT(counts[each], 0) << name << " " << plumbline::name(each);
    EXPECT_GT(counts[Rejection::t], brlcad ? -1 : 0) << name;
  }
}

}  // namespace
}  // namespace plumbline
