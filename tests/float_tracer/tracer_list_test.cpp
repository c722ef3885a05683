// What all tracers have in common.
#include "float_tracer/tracer_list.h"

#include <gmock/gmock.h>

#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

using testing::ElementsAreArray;
using testing::EndsWith;

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& tracer : listed_tracers()) all.push_back(tracer->info().name);
  return all;
}

TEST(TracerList, NamesAreInTableOrder) {
  std::vector<std::string> expected = {"moller_trumbore_f32",       "moller_trumbore_f64", "woop_watertight_f32",
                                       "woop_watertight_f64",       "plucker_f32",         "plucker_f64",
                                       "baldwin_weber_f32",         "baldwin_weber_f64",   "brlcad_bot_classic",
                                       "brlcad_bot_classic_kernel", "brlcad_bot_hlbvh"};
#ifdef PLUMBLINE_TEST_EMBREE
  expected.insert(expected.end(), {"embree_default", "embree_robust"});
#endif
  EXPECT_THAT(names(), ElementsAreArray(expected));
}

TEST(TracerList, EveryTracerSaysWhatItIsAndWhereItComesFrom) {
  for (const auto& tracer : listed_tracers()) {
    EXPECT_FALSE(tracer->info().summary.empty()) << tracer->info().name;
    EXPECT_FALSE(tracer->info().source.empty()) << tracer->info().name;
  }
}

TEST(TracerList, ContractsAreAsDocumented) {
  for (const auto& tracer : listed_tracers()) {
    const TracerInfo& info = tracer->info();
    SCOPED_TRACE(info.name);
    const bool single = info.name.ends_with("_f32") || info.name.starts_with("embree_");
    EXPECT_EQ(info.contract.precision, single ? Precision::binary32 : Precision::binary64);
    const bool embree = info.name.starts_with("embree_"), brlcad = info.name.starts_with("brlcad_");
    EXPECT_EQ(info.contract.edges, embree ? EdgeRule::unspecified : EdgeRule::closed);
    EXPECT_EQ(info.contract.coplanar, embree ? TouchRule::unspecified : TouchRule::miss);
    EXPECT_EQ(info.contract.degenerate, embree ? TouchRule::unspecified : TouchRule::miss);
    EXPECT_EQ(info.contract.t_min, embree || brlcad ? EndRule::unspecified : EndRule::closed);
    EXPECT_EQ(info.contract.t_max, embree ? EndRule::unspecified : EndRule::closed);
    EXPECT_EQ(info.contract.range, info.name == "brlcad_bot_classic_kernel" ? RangeRule::line
                                   : brlcad                                 ? RangeRule::ray
                                                                            : RangeRule::given);
    EXPECT_EQ(info.contract.slack_absolute, 0);
    EXPECT_EQ(info.contract.slack_relative, 0);
  }
}

class EveryTracer : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(TracerList, EveryTracer, testing::ValuesIn(names()), parameter_name);

TEST_P(EveryTracer, HitsTheMiddleFromBothSides) {
  const Bag bag{.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}};
  for (const double side : {1.0, -1.0}) {
    const Answer answer = shoot(GetParam(), bag, {.origin = {1, 1, 8 * side}, .direction = {0, 0, -2 * side}});
    ASSERT_EQ(answer.outcome, Outcome::hit);
    EXPECT_TRUE(answer.has_t);
    EXPECT_EQ(answer.t, 0x1p+2);
    EXPECT_EQ(answer.triangle, 0u);
  }
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
  EXPECT_EQ(answers.back().outcome, Outcome::hit);
}

TEST_P(EveryTracer, TakesNoRays) {
  const auto prepared = tracer_named(GetParam()).prepare({.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}});
  prepared->trace({}, {});
}

TEST_P(EveryTracer, MissesAZeroDirection) {
  const Bag bag{.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}};
  EXPECT_EQ(shoot(GetParam(), bag, {.origin = {1, 1, 0}, .direction = {0, 0, 0}}).outcome, Outcome::miss);
  EXPECT_EQ(shoot(GetParam(), bag, {.origin = {1, 1, 8}, .direction = {0, 0, 0}}).outcome, Outcome::miss);
}

TEST_P(EveryTracer, MissesADegenerateTriangleAndAParallelRay) {
  const Ray down{.origin = {1, 1, 8}, .direction = {0, 0, -1}};
  EXPECT_EQ(shoot(GetParam(), {.triangles = {{{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}}}, down).outcome, Outcome::miss);
  EXPECT_EQ(shoot(GetParam(), {.triangles = {{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}}}, down).outcome, Outcome::miss);
  EXPECT_EQ(shoot(GetParam(), {.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 0, 0}}}}, down).outcome, Outcome::miss);
  const Bag bag{.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}};
  EXPECT_EQ(shoot(GetParam(), bag, {.origin = {-8, 1, 1}, .direction = {1, 0, 0}}).outcome, Outcome::miss);
  EXPECT_EQ(shoot(GetParam(), bag, {.origin = {-8, 1, 0}, .direction = {1, 0, 0}}).outcome, Outcome::miss);
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
