// Hostile tracers: whatever one does at a certain ray, every other answer is that of the unharmed tracer.
#include "float_tracer/isolated.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "tests/float_tracer/hostile.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

void expect_one_fault(Deed deed, const testing::Matcher<std::string>& cause,
                      std::chrono::milliseconds timeout = 10s) {
  const auto tracer = hostile(deed, false, timeout);
  const auto bag = tracer->prepare(one);
  expect_faults(*bag, rays_with({}), {});
  EXPECT_THAT(bag->conduct().deaths, IsEmpty());
  expect_faults(*bag, rays_with({17}), {17});
  EXPECT_THAT(bag->conduct().deaths, ElementsAre(Pair(cause, 1)));
  EXPECT_FALSE(bag->disturbed());
  expect_faults(*bag, rays_with({}), {});
}

void deny(Answer&) {}
void segfault(Answer&) {
  volatile int* nowhere = nullptr;
  std::raise(SIGSEGV);
  *nowhere = 1;
}
void divide(Answer&) { std::raise(SIGFPE); }
void trap(Answer&) { __builtin_trap(); }
void leave(Answer&) { std::exit(0); }
void leave_at_once(Answer&) { _exit(3); }
void sleep_for_ever(Answer&) {
  for (;;) pause();
}
void stop(Answer&) { std::raise(SIGSTOP); }
void complain(Answer&) { throw std::runtime_error("no such ray"); }
void throw_a_number(Answer&) { throw 7; }
void overflow_the_stack(Answer& answer) {
  volatile char frame[4096];
  frame[0] = 1;
  if (answer.triangle != ~0u) overflow_the_stack(answer);
  frame[1] = frame[0];
}
void close_everything(Answer&) {
  for (int i = 0; i < 100; ++i) close(i);
  for (;;) pause();
}

TEST(Isolated, ADeathIsOneFault) {
  expect_one_fault(abort_it, "SIGABRT");
  expect_one_fault(segfault, "SIGSEGV");
  expect_one_fault(divide, "SIGFPE");
  expect_one_fault(leave, "exit code 0");
  expect_one_fault(leave_at_once, "exit code 3");
  expect_one_fault(complain, "exception: no such ray");
  expect_one_fault(throw_a_number, "an exception");
  expect_one_fault(close_everything, "SIGKILL");  // which we had to send
  expect_one_fault(trap, testing::AnyOf("SIGILL", "SIGTRAP"));
}

TEST(Isolated, AStackOverflowIsOneFault) { expect_one_fault(overflow_the_stack, testing::_); }

TEST(Isolated, AHangIsOneFault) {
  for (const Deed deed : {hang, sleep_for_ever, stop}) expect_one_fault(deed, "no answer within 500 ms", 500ms);
}

TEST(Isolated, EveryFatalRayIsAFaultAndNoOther) {
  const auto bag = hostile(abort_it)->prepare(one);  // which outlives its tracer
  expect_faults(*bag, rays_with({0}), {0});
  expect_faults(*bag, rays_with({39}), {39});
  expect_faults(*bag, rays_with({0, 1, 2, 20, 38, 39}), {0, 1, 2, 20, 38, 39});
  expect_faults(*bag, rays_with({0}, 1), {0});
  expect_faults(*bag, rays_with({}, 0), {});
  EXPECT_THAT(bag->conduct().deaths, ElementsAre(Pair("SIGABRT", 9)));
}

TEST(Isolated, BatchesOfAnySize) {
  const auto bag = hostile(abort_it)->prepare(one);
  expect_faults(*bag, rays_with({70'000}, 140'000), {70'000});
  expect_faults(*bag, rays_with({}, 1), {});
  expect_faults(*bag, rays_with({}, 65'536), {});
}

TEST(Isolated, WhatAnEarlierRayDestroyedIsNotBlamedOnALaterOne) {
  // Dies at the second fatal ray in one life; each ray alone is survived.
  const auto bag = hostile([](Answer&) {
                     static int lives = 2;
                     if (--lives == 0) std::abort();
                   })->prepare(one);
  expect_faults(*bag, rays_with({3, 9, 10, 30}), {});
  EXPECT_THAT(bag->conduct().deaths, IsEmpty());
}

TEST(Isolated, ABagThatIsFatalFaultsEveryRay) {
  Bag two = one;
  two.triangles.push_back(one.triangles[0]);
  for (const auto& [deed, cause] :
       {std::pair(Deed(abort_it), "SIGABRT"), std::pair(Deed(complain), "exception: no such ray"),
        std::pair(Deed(sleep_for_ever), "no answer within 1 s")}) {
    const auto tracer = hostile(deed, false, 1s);
    const auto fatal_bag = tracer->prepare(two);
    std::vector<Answer> answers(40);
    fatal_bag->trace(rays_with({}), answers);
    for (const Answer& answer : answers) EXPECT_EQ(answer.outcome, Outcome::fault);
    EXPECT_THAT(fatal_bag->conduct().deaths, ElementsAre(Pair(cause, 40)));
    expect_faults(*tracer->prepare(one), rays_with({5}, 10), {5});
  }
}

TEST(Isolated, OutputOfAnyLengthGoesNowhere) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const auto bag = hostile([](Answer&) {
                     for (int i = 0; i < 200'000; ++i) {
                       std::fprintf(stdout, "a flood of output\n");
                       std::fprintf(stderr, "a flood of errors\n");
                     }
                     std::fflush(stdout);
                     if (std::getchar() != EOF) std::abort();
                   })->prepare(one);
  expect_faults(*bag, rays_with({17}), {});
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

void answer_nan(Answer& answer) { answer = {.outcome = Outcome::hit, .has_t = true, .t = not_a_number}; }

TEST(Isolated, ANaNIsTheTracersOwn) {
  const Hostile in_process(answer_nan);
  const auto wrapped = hostile(answer_nan);
  for (const Tracer* tracer : {static_cast<const Tracer*>(&in_process), static_cast<const Tracer*>(wrapped.get())}) {
    const auto rays = rays_with({17});
    std::vector<Answer> answers(rays.size());
    tracer->prepare(one)->trace(rays, answers);
    auto right = unharmed(one, rays);
    answer_nan(right[17]);
    for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_TRUE(same(answers[i], right[i])) << i;
  }
}

TEST(Isolated, TellsWhatItIsReallyAsked) {
  const auto tracer = hostile(abort_it, true);
  const auto bag = tracer->prepare(one);
  auto rays = rays_with({17});
  rays[3].origin.x = not_a_number;
  const auto expect_asked = [&](std::size_t i) {
    Query right = rays[i];
    if (i != 17) right.ray.t_min = -1;
    const Query query = bag->asked(rays[i]);
    EXPECT_EQ(std::memcmp(&query, &right, sizeof query), 0) << i;
  };
  expect_asked(20);  // before there is a batch
  expect_asked(17);
  EXPECT_THAT(bag->conduct().deaths, IsEmpty());
  expect_faults(*bag, rays, {17});
  for (std::size_t i = 0; i < rays.size(); ++i) expect_asked(i);
  for (const std::size_t i : {30, 2, 2, 39, 0}) expect_asked(i);
  EXPECT_THAT(bag->conduct().deaths, ElementsAre(Pair("SIGABRT", 1)));
}

TEST(Isolated, TheBagArrivesWhole) {
  const Bag plate{.triangles = std::vector<Triangle>(5000, one.triangles[0]),
                  .mode = BagMode::plate,
                  .thickness = 0.25,
                  .position = PlatePosition::appended,
                  .cosine = false,
                  .orientation = Orientation::cw};
  class Comparing final : public Tracer {
   public:
    explicit Comparing(const Bag& right)
        : Tracer({.name = "comparing", .summary = "", .source = "", .contract = {}}), right_(right) {}
    std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
      if (!(bag == right_)) throw std::runtime_error("another bag");
      return kernel_.prepare(bag);
    }

   private:
    Bag right_;
    KernelTracer<MollerTrumbore<double>> kernel_;
  };
  const auto tracer = isolated(std::make_unique<Comparing>(plate));
  expect_faults(*tracer->prepare(plate), rays_with({}), {});
}

TEST(Isolated, SaysSoAndNothingElse) {
  const auto tracer = hostile(deny, true);
  EXPECT_EQ(tracer->info().isolation, Isolation::process);
  EXPECT_EQ(tracer->info().name, "hostile");
  EXPECT_TRUE(tracer->info().own_queries);
}

}  // namespace
}  // namespace plumbline
