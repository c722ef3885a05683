// What all tracers have in common, whichever there are: to add one breaks nothing here.
#include "float_tracer/tracer_list.h"

#include <gmock/gmock.h>

#include <set>
#include <utility>

#include "tests/float_tracer/expect_contract.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

using testing::IsSubsetOf;

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& tracer : listed_tracers()) all.push_back(tracer->info().name);
  return all;
}

// The groups of the table, in its order.
enum class Group { kernel, variant, brlcad, library };

Group group_of(const std::string& name) {
  if (!tracer_named(name).info().package.empty()) return Group::library;
  if (name.starts_with("brlcad_")) return Group::brlcad;
  for (const char* how : {"_fma", "_fast_math", "_ftz_daz"})
    if (name.ends_with(how)) return Group::variant;
  return Group::kernel;
}

TEST(TracerList, NamesAreUniqueAndInTheOrderOfTheirGroups) {
  const auto all = names();
  EXPECT_EQ(std::set(all.begin(), all.end()).size(), all.size());
  EXPECT_TRUE(std::ranges::is_sorted(all, {}, group_of)) << testing::PrintToString(all);
}

TEST(TracerList, HoldsTheOnesWeKnow) {
  std::vector<std::string> known = {
      "moller_trumbore_f32", "moller_trumbore_f64", "woop_watertight_f32",      "woop_watertight_f64",
      "plucker_f32",         "plucker_f64",         "baldwin_weber_f32",        "baldwin_weber_f64",
      "brlcad_bot_classic",  "brlcad_bot_hlbvh",    "brlcad_bot_classic_kernel"};
#ifdef PLUMBLINE_TEST_EMBREE
  known.insert(known.end(), {"embree_default", "embree_robust"});
#endif
#ifdef PLUMBLINE_TEST_CGAL
  known.insert(known.end(), {"cgal_cartesian_f64", "cgal_epick", "cgal_epeck"});
#endif
#ifdef PLUMBLINE_TEST_GTS
  known.push_back("gts_segment_f64");
#endif
#ifdef PLUMBLINE_TEST_WILD_MAGIC
  known.insert(known.end(), {"wild_magic_f32", "wild_magic_f64"});
#endif
#ifdef PLUMBLINE_TEST_IRRLICHT
  known.insert(known.end(), {"irrlicht_f32", "irrlicht_f64"});
#endif
#ifdef PLUMBLINE_TEST_OGRE
  known.insert(known.end(), {"ogre_f32"});
#endif
#ifdef PLUMBLINE_TEST_GZ_MATH
  known.insert(known.end(), {"gz_math_f32", "gz_math_f64"});
#endif
#ifdef PLUMBLINE_TEST_VTK
  known.insert(known.end(), {"vtk_triangle", "vtk_triangle_tolerant", "vtk_obb_tree", "vtk_cell_locator",
                             "vtk_static_cell_locator"});
#endif
#ifdef PLUMBLINE_TEST_BRLCAD
  known.push_back("brlcad_librt");
#endif
  EXPECT_THAT(known, IsSubsetOf(names()));
}

TEST(TracerList, EveryTracerSaysWhatItIsAndWhereItComesFrom) {
  for (const auto& tracer : listed_tracers()) {
    EXPECT_FALSE(tracer->info().summary.empty()) << tracer->info().name;
    EXPECT_FALSE(tracer->info().source.empty()) << tracer->info().name;
  }
}

TEST(TracerList, ContractsOfTheOnesWeKnowAreAsDocumented) {
  for (const std::string kernel : {"moller_trumbore", "woop_watertight", "plucker", "baldwin_weber"}) {
    expect_contract(kernel + "_f32", {.precision = Precision::binary32});
    expect_contract(kernel + "_f64", {.precision = Precision::binary64});
  }
  for (const auto& [tracer, range] :
       {std::pair("brlcad_bot_classic", RangeRule::ray), std::pair("brlcad_bot_hlbvh", RangeRule::ray),
        std::pair("brlcad_bot_classic_kernel", RangeRule::line)})
    expect_contract(tracer, {.range = range, .t_min = EndRule::unspecified});
#ifdef PLUMBLINE_TEST_BRLCAD
  expect_contract("brlcad_librt", {.range = RangeRule::ray, .t_min = EndRule::unspecified});
#endif
#ifdef PLUMBLINE_TEST_EMBREE
  for (const char* tracer : {"embree_default", "embree_robust", "embree_default_w8", "embree_robust_occluded"})
    expect_contract(tracer, {.precision = Precision::binary32,
                             .edges = EdgeRule::unspecified,
                             .t_min = EndRule::unspecified,
                             .t_max = EndRule::unspecified,
                             .coplanar = TouchRule::unspecified,
                             .degenerate = TouchRule::unspecified});
#endif
#ifdef PLUMBLINE_TEST_CGAL
  for (const char* tracer : {"cgal_cartesian_f64", "cgal_epick", "cgal_epeck"})
    expect_contract(tracer,
                    {.range = RangeRule::ray, .coplanar = TouchRule::hit, .degenerate = TouchRule::unspecified});
#endif
#ifdef PLUMBLINE_TEST_GTS
  expect_contract("gts_segment_f64", {.degenerate = TouchRule::unspecified});
#endif
  for (const auto& [suffix, precision] :
       {std::pair<std::string, Precision>("_f32", Precision::binary32), {"_f64", Precision::binary64}}) {
#ifdef PLUMBLINE_TEST_WILD_MAGIC
    expect_contract("wild_magic" + suffix, {.precision = precision,
                                            .edges = EdgeRule::unspecified,
                                            .range = RangeRule::ray,
                                            .coplanar = TouchRule::unspecified,
                                            .degenerate = TouchRule::unspecified});
#endif
#ifdef PLUMBLINE_TEST_IRRLICHT
    expect_contract("irrlicht" + suffix, {.precision = precision,
                                          .range = RangeRule::line,
                                          .coplanar = TouchRule::unspecified,
                                          .degenerate = TouchRule::unspecified});
#endif
#ifdef PLUMBLINE_TEST_GZ_MATH
    expect_contract("gz_math" + suffix, {.precision = precision,
                                         .t_min = EndRule::unspecified,
                                         .t_max = EndRule::unspecified,
                                         .coplanar = TouchRule::hit,
                                         .degenerate = TouchRule::unspecified});
#endif
  }
#ifdef PLUMBLINE_TEST_OGRE
  expect_contract("ogre_f32", {.precision = Precision::binary32,
                               .edges = EdgeRule::unspecified,
                               .range = RangeRule::ray,
                               .t_min = EndRule::unspecified,
                               .coplanar = TouchRule::unspecified,
                               .degenerate = TouchRule::unspecified});
#endif
#ifdef PLUMBLINE_TEST_VTK
  Contract vtk{.edges = EdgeRule::unspecified,
               .t_min = EndRule::unspecified,
               .t_max = EndRule::unspecified,
               .coplanar = TouchRule::unspecified,
               .degenerate = TouchRule::unspecified};
  for (const char* tracer : {"vtk_triangle", "vtk_obb_tree", "vtk_cell_locator", "vtk_static_cell_locator"})
    expect_contract(tracer, vtk);
  vtk.slack_absolute = 1e-6;
  expect_contract("vtk_triangle_tolerant", vtk);
#endif
}

class EveryTracer : public testing::TestWithParam<std::string> {
 protected:
  const Contract& contract() const { return tracer_named(GetParam()).info().contract; }
};
INSTANTIATE_TEST_SUITE_P(TracerList, EveryTracer, testing::ValuesIn(names()), parameter_name);

TEST_P(EveryTracer, HitsTheMiddleFromEverySideThatIsNotCulled) {
  const Bag bag{.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}};
  for (const double side : {1.0, -1.0}) {  // front, back
    if (contract().culling == (side > 0 ? Culling::front : Culling::back)) continue;
    const Ray ray{.origin = {1, 1, 8 * side}, .direction = {0, 0, -2 * side}};
    const Answer answer = shoot(GetParam(), bag, ray);
    ASSERT_EQ(answer.outcome, Outcome::hit);
    if (answer.has_t) {  // in the query that it was really asked, whose direction may have another length
      const Query query = tracer_named(GetParam()).prepare(bag)->asked(ray);
      const auto at = [&](double origin, double direction, double tail) {
        return origin + answer.t * (direction + tail);
      };
      const auto& [origin, direction, t_min, t_max] = query.ray;
      EXPECT_NEAR(at(origin.x, direction.x, query.direction_tail.x), 1, 0x1p-16);
      EXPECT_NEAR(at(origin.y, direction.y, query.direction_tail.y), 1, 0x1p-16);
      EXPECT_NEAR(at(origin.z, direction.z, query.direction_tail.z), 0, 0x1p-15);
    }
    EXPECT_EQ(answer.triangle, 0u);
  }
}

TEST_P(EveryTracer, AsksTheRayItselfUnlessItSaysOtherwise) {
  if (tracer_named(GetParam()).info().own_queries) GTEST_SKIP();
  const Ray ray{.origin = {0.1, 0.2, 8}, .direction = {0.3, 0.1, -2}, .t_min = 0.5, .t_max = 4};
  const Bag bag{.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}};
  EXPECT_EQ(tracer_named(GetParam()).prepare(bag)->asked(ray), Query(ray));
}

TEST_P(EveryTracer, AnswersABatchAsItAnswersEachRay) {
  const Bag bag{.triangles = {{{0.5, 0, 0.25}, {4, 0.75, 0}, {0, 4, 1}}}};
  std::vector<Ray> rays;
  for (int i = -4; i < 12; ++i)
    for (int j = -4; j < 12; ++j)
      rays.push_back({.origin = {i * 0.5, j * 0.5, 5}, .direction = {0.125 * (i - j), 0.0625 * j, -1}});
  rays.push_back({.origin = {not_a_number, 1, 5}, .direction = {0, 0, -1}});  // does not spoil its neighbours
  rays.push_back({.origin = {1, 1, 5}, .direction = {0, 0, -1}});

  std::vector<Answer> answers(rays.size());
  const auto prepared = tracer_named(GetParam()).prepare(bag);
  prepared->trace(rays, answers);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Answer alone = shoot(GetParam(), bag, rays[i]);
    EXPECT_EQ(answers[i].outcome, alone.outcome) << i;
    EXPECT_EQ(answers[i].t, alone.t) << i;
    EXPECT_EQ(answers[i].u, alone.u) << i;
    EXPECT_EQ(answers[i].v, alone.v) << i;
    EXPECT_EQ(answers[i].in, alone.in) << i;
    EXPECT_EQ(answers[i].out, alone.out) << i;
  }
  EXPECT_EQ(answers.back().outcome, contract().culling == Culling::front ? Outcome::miss : Outcome::hit);
}

TEST_P(EveryTracer, TakesNoRays) {
  const auto prepared = tracer_named(GetParam()).prepare({.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}});
  prepared->trace({}, {});
}

TEST_P(EveryTracer, NeverHitsAlongAZeroDirection) {
  const Bag bag{.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}};
  EXPECT_NE(shoot(GetParam(), bag, {.origin = {1, 1, 0}, .direction = {0, 0, 0}}).outcome, Outcome::hit);
  EXPECT_NE(shoot(GetParam(), bag, {.origin = {1, 1, 8}, .direction = {0, 0, 0}}).outcome, Outcome::hit);
}

TEST_P(EveryTracer, NeverHitsADegenerateTriangleUnlessItMay) {
  const Ray down{.origin = {1, 1, 8}, .direction = {0, 0, -1}};
  EXPECT_NE(shoot(GetParam(), {.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 0, 0}}}}, down).outcome, Outcome::hit);
  if (contract().degenerate != TouchRule::miss) return;  // the next two lie in the way
  EXPECT_NE(shoot(GetParam(), {.triangles = {{{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}}}, down).outcome, Outcome::hit);
  EXPECT_NE(shoot(GetParam(), {.triangles = {{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}}}, down).outcome, Outcome::hit);
}

TEST_P(EveryTracer, NeverHitsWhereARayIsParallel) {
  const Bag bag{.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}};
  EXPECT_NE(shoot(GetParam(), bag, {.origin = {-8, 1, 1}, .direction = {1, 0, 0}}).outcome, Outcome::hit);
  if (contract().coplanar != TouchRule::miss) return;
  EXPECT_NE(shoot(GetParam(), bag, {.origin = {-8, 1, 0}, .direction = {1, 0, 0}}).outcome, Outcome::hit);
}

TEST_P(EveryTracer, NeverHitsANaN) {
  const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const Ray ray{.origin = {1, 1, 8}, .direction = {0, 0, -2}};
  for (std::size_t i = 0; i < 9; ++i) {
    Triangle spoilt = triangle;
    *coordinates(spoilt)[i] = not_a_number;
    EXPECT_NE(shoot(GetParam(), {.triangles = {spoilt}}, ray).outcome, Outcome::hit) << "triangle coordinate " << i;
  }
  for (std::size_t i = 0; i < 6; ++i) {
    Ray spoilt = ray;
    *coordinates(spoilt)[i] = not_a_number;
    EXPECT_NE(shoot(GetParam(), {.triangles = {triangle}}, spoilt).outcome, Outcome::hit) << "ray coordinate " << i;
  }
}

}  // namespace
}  // namespace plumbline
