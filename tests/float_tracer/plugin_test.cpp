// Libraries that keep to plumbline_tracer.h, and one for each way not to: whatever one does, nothing else is lost.
#include "float_tracer/plugin.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
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
  std::string complaints;
};
Told three_rays(const std::string& name) {
  Told told;
  const std::array rays = {down, down, down};
  const auto bag = load(name)->prepare({.triangles = {unit}});
  bag->trace(rays, told.answers);
  told.complaints = complaints("it", bag->conduct());
  return told;
}
std::vector<Outcome> outcomes(const Told& told) {
  return {told.answers[0].outcome, told.answers[1].outcome, told.answers[2].outcome};
}
const std::vector all_faults(3, Outcome::fault);

// The `deed` happens at the rays with t_max 7; where there is none, the answer is a hit at the origin's x.
constexpr std::size_t many = 40;
std::vector<Ray> rays_with(const std::vector<std::size_t>& deeds) {
  std::vector<Ray> rays(many, down);
  for (std::size_t i = 0; i < many; ++i) rays[i].origin.x = 0.125 * static_cast<double>(i);
  for (const std::size_t i : deeds) rays[i].t_max = 7;
  return rays;
}
// What is wrong with the answers but for those of `apart`, which are given to `check`.
template <class Check>
void expect_unharmed(std::span<const Answer> answers, const std::vector<std::size_t>& apart, Check check) {
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (std::ranges::count(apart, i) != 0) {
      check(answers[i]);
    } else {
      EXPECT_EQ(answers[i].outcome, Outcome::hit) << i;
      EXPECT_EQ(answers[i].t, 0.125 * static_cast<double>(i)) << i;
    }
  }
}
void expect_fault(const Answer& answer) { EXPECT_EQ(answer.outcome, Outcome::fault); }

TEST(Plugin, IsToldByItsName) {
  for (const char* name : {"./libmine.so", "libmine.so", "../build/mine", "/lib/mine.so.3"})
    EXPECT_TRUE(names_plugin(name)) << name;
  for (const char* name : {"exact", "plucker_f32", "", "so"}) EXPECT_FALSE(names_plugin(name)) << name;
}

TEST(Plugin, TheExampleHitsAndMisses) {
  const auto tracer = load("example");
  EXPECT_EQ(tracer->info().name, "my_tracer");
  EXPECT_EQ(tracer->info().contract.precision, Precision::binary64);
  EXPECT_EQ(tracer->info().isolation, Isolation::process);
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
  EXPECT_THAT(refusal("version"), HasSubstr("version 7 of plumbline_tracer.h, and this program is of version 2"));
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
    EXPECT_EQ(told.complaints, std::string("it: ") + complaint + "\n");
  }
}

TEST(Plugin, AnImpossibleAnswerIsAFaultAlone) {
  for (const auto& [name, complaint] : {std::pair("outcome", "trace() gave the outcome 3"),
                                        {"triangle", "trace() hit triangle 1 of 1 (they count from 0)"}}) {
    const Told told = three_rays(name);
    EXPECT_EQ(outcomes(told), (std::vector{Outcome::hit, Outcome::fault, Outcome::hit})) << name;
    EXPECT_THAT(told.complaints, HasSubstr(complaint));
  }
}

TEST(Plugin, AnImpossibleQueryIsNotUsed) {
  const auto tracer = load("tail");
  EXPECT_TRUE(tracer->info().own_queries);
  const auto bag = tracer->prepare({.triangles = {unit}});
  Answer answer;
  bag->trace({&down, 1}, {&answer, 1});
  EXPECT_EQ(bag->asked(down), Query(down));
  EXPECT_THAT(complaints("it", bag->conduct()), HasSubstr("direction_tail"));
}

TEST(Plugin, ABagThatItCantTakeIsAFault) {
  EXPECT_EQ(shoot(*load("tame"), {}, down).outcome, Outcome::fault);
  EXPECT_EQ(shoot(*load("tame"), {.triangles = {unit}}, down).outcome, Outcome::hit);
}

TEST(Plugin, ADeathIsOneFault) {
  for (const auto& [deed, cause] : {std::pair("aborts", "SIGABRT"),
                                    {"segfaults", "SIGSEGV"},
                                    {"traps", "SIGFPE"},
                                    {"ends", "exit code 0"}}) {
    SCOPED_TRACE(deed);
    const auto bag = load(deed)->prepare({.triangles = {unit}});
    for (const std::vector<std::size_t>& at : {std::vector<std::size_t>{}, {0}, {17, 18, 39}}) {
      std::vector<Answer> answers(many);
      bag->trace(rays_with(at), answers);
      expect_unharmed(answers, at, expect_fault);
    }
    EXPECT_EQ(bag->conduct(), (Conduct{.deaths = {{cause, 4}}}));
  }
}

TEST(Plugin, AHangIsOneFault) {
  const auto bag = load_plugin(path_of("hangs"), 0.5)->prepare({.triangles = {unit}});
  std::vector<Answer> answers(many);
  bag->trace(rays_with({17}), answers);
  expect_unharmed(answers, {17}, expect_fault);
  EXPECT_EQ(bag->conduct(), (Conduct{.deaths = {{"no answer within 500 ms", 1}}}));
}

TEST(Plugin, ADeathAtABagIsThatBagsFault) {
  for (const auto& [deed, cause] :
       {std::pair("aborts_bag", "SIGABRT"), {"hangs_bag", "no answer within 500 ms"}}) {
    SCOPED_TRACE(deed);
    const auto tracer = load_plugin(path_of(deed), 0.5);
    const auto fatal = tracer->prepare({.triangles = {unit, above}});
    const auto harmless = tracer->prepare({.triangles = {unit}});
    std::vector<Answer> answers(many);
    fatal->trace(rays_with({}), answers);
    for (const Answer& answer : answers) expect_fault(answer);
    EXPECT_EQ(fatal->conduct(), (Conduct{.deaths = {{cause, many}}}));
    harmless->trace(rays_with({}), answers);
    expect_unharmed(answers, {}, expect_fault);
    EXPECT_EQ(harmless->conduct(), Conduct{});
  }
}

TEST(Plugin, ADeathInLoadingIsToldAsWhatIsWrongWithTheFile) {
  EXPECT_THAT(refusal("aborts_loading"),
              AllOf(HasSubstr(path_of("aborts_loading") + ": "), HasSubstr("describe itself: SIGABRT; load it in")));
  EXPECT_THAT(error_of([] { load_plugin(path_of("hangs_loading"), 0.5); }), HasSubstr("no answer within 500 ms"));
}

TEST(Plugin, OutputOfAnyLengthGoesNowhere) {
  for (const char* name : {"floods", "floods_bag", "floods_loading"}) {
    SCOPED_TRACE(name);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const auto bag = load(name)->prepare({.triangles = {unit, above}});
    std::vector<Answer> answers(many);
    bag->trace(rays_with({17}), answers);
    expect_unharmed(answers, {}, expect_fault);
    EXPECT_EQ(bag->conduct(), Conduct{});
    EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
  }
}

TEST(Plugin, ANaNIsItsOwnAnswer) {
  const auto bag = load("answers_nan")->prepare({.triangles = {unit}});
  std::vector<Answer> answers(many);
  bag->trace(rays_with({17}), answers);
  expect_unharmed(answers, {17}, [](const Answer& answer) {
    EXPECT_EQ(answer.outcome, Outcome::hit);
    EXPECT_TRUE(std::isnan(answer.t));
  });
}

TEST(Plugin, ChangedControlsAreTold) {
  for (const char* name : {"rounds_upward", "rounds_upward_bag"}) {
    const auto tracer = load(name);
    const auto bag = tracer->prepare({.triangles = {unit, above}}), other = tracer->prepare({.triangles = {unit}});
    std::vector<Answer> answers(many);
    bag->trace(rays_with({17}), answers);
    expect_unharmed(answers, {}, expect_fault);
    EXPECT_EQ(bag->conduct(), Conduct{.disturbed = true}) << name;
    other->trace(rays_with({}), answers);
    EXPECT_EQ(other->conduct(), Conduct{}) << name;
  }
  // Put back at once: it is how libraries that were linked with -ffast-math load.
  const auto bag = load("rounds_upward_loading")->prepare({.triangles = {unit}});
  std::vector<Answer> answers(many);
  bag->trace(rays_with({}), answers);
  EXPECT_EQ(bag->conduct(), Conduct{});
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

TEST(Plugin, BreachesAreCounted) {
  const auto bag = load("fewer")->prepare({.triangles = {unit}});
  std::vector<Answer> answers(20);
  const auto trace = [&](std::size_t n) {
    bag->trace(std::vector(n, down), std::span(answers).first(n));
  };
  for (int i = 0; i < 25; ++i) trace(3);
  trace(2);
  EXPECT_EQ(complaints("it", bag->conduct()),
            "it: trace() answered 1 of 2 rays; all 2 are faults\n"
            "it: trace() answered 2 of 3 rays; all 3 are faults (25 times)\n");
  for (std::size_t n = 1; n <= 20; ++n) trace(n);  // no end of sentences
  EXPECT_EQ(bag->conduct().breaches.size(), 13u);
  EXPECT_EQ(bag->conduct().breaches.at("broke plumbline_tracer.h in further ways"), 8u);
}

}  // namespace
}  // namespace plumbline
