#include "float_tracer/plugin.h"

#include <gmock/gmock.h>

#include <array>
#include <cfenv>
#include <fstream>
#include <thread>

#include "tests/case/error_of.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const Triangle unit = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const Triangle above = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
const Ray down = {{0.25, 0.5, 2}, {0, 0, -1}};

std::string path_of(const std::string& name) { return PLUMBLINE_PLUGINS + name + ".so"; }
std::unique_ptr<Tracer> load(const std::string& name) { return load_plugin(path_of(name)); }
std::string refusal(const std::string& name) {
  return error_of([&] { load(name); });
}

// What three rays get, and what is told of them.
struct Told {
  std::array<Answer, 3> answers;
  std::string complaint;
};
Told three_rays(const std::string& name) {
  Told told;
  testing::internal::CaptureStderr();
  {
    const auto tracer = load(name);
    const std::array rays = {down, down, down};
    tracer->prepare({.triangles = {unit}})->trace(rays, told.answers);
  }
  told.complaint = testing::internal::GetCapturedStderr();
  return told;
}
std::vector<Outcome> outcomes(const Told& told) {
  return {told.answers[0].outcome, told.answers[1].outcome, told.answers[2].outcome};
}
const std::vector all_faults(3, Outcome::fault);

TEST(Plugin, IsToldByItsName) {
  for (const char* name : {"./libmine.so", "libmine.so", "../build/mine", "/lib/mine.so.3"})
    EXPECT_TRUE(names_plugin(name)) << name;
  for (const char* name : {"exact", "plucker_f32", "", "so"}) EXPECT_FALSE(names_plugin(name)) << name;
}

TEST(Plugin, TheExampleHitsAndMisses) {
  const auto tracer = load("example");
  EXPECT_EQ(tracer->info().name, "my_tracer");
  EXPECT_EQ(tracer->info().contract.precision, Precision::binary64);
  EXPECT_EQ(tracer->info().isolation, Isolation::none);
  EXPECT_FALSE(tracer->info().own_queries);

  const Answer hit = shoot(*tracer, {.triangles = {unit}}, down);
  EXPECT_EQ(hit.outcome, Outcome::hit);
  EXPECT_TRUE(hit.has_t && hit.has_uv);
  EXPECT_EQ(hit.t, 2);
  EXPECT_EQ(hit.u, 0.25);
  EXPECT_EQ(hit.v, 0.5);
  EXPECT_EQ(shoot(*tracer, {.triangles = {unit, above}}, down).triangle, 1u);
  EXPECT_EQ(shoot(*tracer, {.triangles = {above, unit}}, down).triangle, 0u);
  EXPECT_EQ(shoot(*tracer, {.triangles = {unit}}, {{2, 2, 2}, {0, 0, -1}}).outcome, Outcome::miss);
  EXPECT_EQ(shoot(*tracer, {.triangles = {unit}}, {{0.25, 0.5, 2}, {0, 0, -1}, 0, 1}).outcome, Outcome::miss);
  EXPECT_EQ(shoot(*tracer, {.triangles = {unit}}, {{0.25, 0.5, 2}, {1, 0, 0}}).outcome, Outcome::miss);
  EXPECT_EQ(shoot(*tracer, {}, down).outcome, Outcome::miss);
}

TEST(Plugin, TheDefaultContractIsPlumblines) {
  const Contract contract = load("tame")->info().contract, defaults;
  EXPECT_EQ(contract.precision, Precision::binary32);
  EXPECT_EQ(contract.edges, defaults.edges);
  EXPECT_EQ(contract.range, defaults.range);
  EXPECT_EQ(contract.t_min, defaults.t_min);
  EXPECT_EQ(contract.t_max, defaults.t_max);
  EXPECT_EQ(contract.coplanar, defaults.coplanar);
  EXPECT_EQ(contract.degenerate, defaults.degenerate);
  EXPECT_EQ(contract.culling, defaults.culling);
}

TEST(Plugin, WhatCantBeLoadedIsToldWithPlaceAndFix) {
  EXPECT_THAT(refusal("none"), AllOf(HasSubstr(path_of("none") + ": cannot be opened: No such file or directory"),
                                     HasSubstr("build it, or correct the path")));
  EXPECT_THAT(error_of([] { load_plugin(PLUMBLINE_PLUGINS); }), HasSubstr("is a folder"));
  const std::string text = testing::TempDir() + "no_library.so";
  std::ofstream(text) << "no library\n";
  EXPECT_THAT(error_of([&] { load_plugin(text); }), HasSubstr("cannot be loaded: "));
  EXPECT_THAT(refusal("no_symbol"), HasSubstr("exports no function 'plumbline_tracer'; define it"));
  EXPECT_THAT(refusal("no_table"), HasSubstr("plumbline_tracer() returned NULL; return"));
  EXPECT_THAT(refusal("version"), HasSubstr("version 7 of plumbline_tracer.h, and this program is of version 1"));
  EXPECT_THAT(refusal("null_describe"), HasSubstr("'describe' is NULL; fill it in"));
  EXPECT_THAT(refusal("null_prepare"), HasSubstr("'prepare_f32' is NULL; fill it in, or set precision to 64"));
  EXPECT_THAT(refusal("null_trace"), HasSubstr("'trace_f32' is NULL"));
  EXPECT_THAT(refusal("null_release"), HasSubstr("'release' is NULL"));
  EXPECT_THAT(refusal("precision"), HasSubstr("precision to 80; set 32 or 64"));
  EXPECT_THAT(refusal("edges"), HasSubstr("edges to 4; it can be 0 to 3"));
  EXPECT_THAT(refusal("slack"), HasSubstr("slack_absolute to -1; set a finite number"));
  EXPECT_THAT(refusal("name"), HasSubstr("the name 'two words'; set one word"));
}

TEST(Plugin, ACountThatLiesMakesFaultsOfAll) {
  for (const auto& [name, complaint] :
       {std::pair("fewer", "trace() answered 2 of 3 rays; all 3 are faults"),
        {"more", "trace() answered 4 of 3 rays; all 3 are faults"},
        {"behind", "trace() wrote behind its 3 answers; all 3 are faults"},
        {"unset", "trace() left the outcome of answer 2 of 3 unset; all 3 are faults"}}) {
    const Told told = three_rays(name);
    EXPECT_EQ(outcomes(told), all_faults) << name;
    EXPECT_EQ(told.complaint, "warning: " + path_of(name) + ": " + complaint + "\n");
  }
}

TEST(Plugin, AnImpossibleAnswerIsAFaultAlone) {
  for (const auto& [name, complaint] : {std::pair("outcome", "trace() gave the outcome 3"),
                                        {"triangle", "trace() hit triangle 1 of 1 (they count from 0)"}}) {
    const Told told = three_rays(name);
    EXPECT_EQ(outcomes(told), (std::vector{Outcome::hit, Outcome::fault, Outcome::hit})) << name;
    EXPECT_THAT(told.complaint, HasSubstr(complaint));
  }
}

TEST(Plugin, AnImpossibleQueryIsNotUsed) {
  const auto tracer = load("tail");
  EXPECT_TRUE(tracer->info().own_queries);
  testing::internal::CaptureStderr();
  EXPECT_EQ(tracer->prepare({.triangles = {unit}})->asked(down), Query(down));
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("direction_tail"));
}

TEST(Plugin, ABagThatItCantTakeIsAFault) {
  EXPECT_EQ(shoot(*load("tame"), {}, down).outcome, Outcome::fault);
  EXPECT_EQ(shoot(*load("tame"), {.triangles = {unit}}, down).outcome, Outcome::hit);
}

TEST(Plugin, TheFloatingPointControlsArePutBack) {
  const auto bag = load("controls");
  const auto prepared = bag->prepare({.triangles = {unit}});
  Answer answer;
  prepared->trace({&down, 1}, {&answer, 1});
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
#if defined(__x86_64__)
  EXPECT_TRUE(prepared->disturbed());
#endif
}

TEST(Plugin, SeveralThreadsMayAsk) {
  const auto tracer = load("example");
  std::vector<std::thread> threads;
  std::array<int, 4> hits{};
  for (int& count : hits)
    threads.emplace_back([&] {
      for (int i = 0; i < 200; ++i) count += shoot(*tracer, {.triangles = {unit}}, down).outcome == Outcome::hit;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(hits, (std::array{200, 200, 200, 200}));
}

TEST(Plugin, ManyComplaintsAreCounted) {
  testing::internal::CaptureStderr();
  {
    const auto tracer = load("fewer");
    for (int i = 0; i < 25; ++i) shoot(*tracer, {.triangles = {unit}}, down);
  }
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::ranges::count(told, '\n'), 11);
  EXPECT_THAT(told, testing::EndsWith(": 15 more of these\n"));
}

}  // namespace
}  // namespace plumbline
