// Hostile tracers: whatever one does at a certain ray, every other answer is that of the unharmed tracer.
#include "float_tracer/isolated.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cfenv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <thread>
#ifdef __x86_64__
#include <xmmintrin.h>
#endif

#include "float_tracer/float_environment.h"
#include "float_tracer/kernel_tracer.h"
#include "float_tracer/moller_trumbore.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

using Deed = void (*)(Answer& answer);

// At a ray with t_max 7, the deed, after the answer; at a bag of two triangles, the deed instead of a bag.
constexpr double fatal = 7;

class HostileBag final : public PreparedBag {
 public:
  HostileBag(std::unique_ptr<PreparedBag> bag, Deed deed) : bag_(std::move(bag)), deed_(deed) {}
  Query asked(const Ray& ray) override {
    Query query = ray;
    query.ray.t_min = -1;
    return query;
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      bag_->trace(rays.subspan(i, 1), answers.subspan(i, 1));
      if (rays[i].t_max == fatal) deed_(answers[i]);
    }
  }

  std::unique_ptr<PreparedBag> bag_;
  Deed deed_;
};

class Hostile final : public Tracer {
 public:
  explicit Hostile(Deed deed, bool own_queries = false)
      : Tracer({.name = "hostile",
                .summary = "",
                .source = "",
                .contract = {},
                .own_queries = own_queries,
                .isolation = Isolation::process}),
        deed_(deed) {}
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    Answer none;
    if (bag.triangles.size() == 2) deed_(none);
    return std::make_unique<HostileBag>(kernel_.prepare(bag), deed_);
  }

 private:
  Deed deed_;
  KernelTracer<MollerTrumbore<double>> kernel_;
};

std::unique_ptr<Tracer> hostile(Deed deed, bool own_queries = false, std::chrono::milliseconds timeout = 10s) {
  return isolated(std::make_unique<Hostile>(deed, own_queries), {.timeout = timeout});
}

const Bag one{.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}};

std::vector<Ray> rays_with(std::initializer_list<std::size_t> fatal_rays, std::size_t n = 40) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < n; ++i)
    rays.push_back({.origin = {0.125 * static_cast<double>(i % 64), 0.5, 5}, .direction = {0, 0, -1}, .t_max = 8});
  for (const std::size_t i : fatal_rays) rays[i].t_max = fatal;
  return rays;
}

bool same(const Answer& a, const Answer& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  return a.outcome == b.outcome && a.has_t == b.has_t && a.has_uv == b.has_uv && a.has_segment == b.has_segment &&
         a.triangle == b.triangle && bits(a.t) == bits(b.t) && bits(a.u) == bits(b.u) && bits(a.v) == bits(b.v);
}

std::vector<Answer> unharmed(const Bag& bag, std::span<const Ray> rays) {
  std::vector<Answer> answers(rays.size());
  KernelTracer<MollerTrumbore<double>>().prepare(bag)->trace(rays, answers);
  return answers;
}

// All as unharmed but for faults at these.
void expect_faults(PreparedBag& bag, std::span<const Ray> rays, const std::vector<std::size_t>& faults) {
  std::vector<Answer> answers(rays.size());
  bag.trace(rays, answers);
  const auto right = unharmed(one, rays);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (answers[i].outcome == Outcome::fault) {
      found.push_back(i);
    } else {
      EXPECT_TRUE(same(answers[i], right[i])) << "ray " << i;
    }
  EXPECT_EQ(found, faults);
}

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
void abort_it(Answer&) { std::abort(); }
void segfault(Answer&) {
  volatile int* nowhere = nullptr;
  std::raise(SIGSEGV);
  *nowhere = 1;
}
void divide(Answer&) { std::raise(SIGFPE); }
void trap(Answer&) { __builtin_trap(); }
void leave(Answer&) { std::exit(0); }
void leave_at_once(Answer&) { _exit(3); }
void hang(Answer&) {
  volatile int i = 0;
  for (;;) i = i + 1;
}
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

void round_upward(Answer&) { std::fesetround(FE_UPWARD); }
#ifdef __x86_64__
void flush_to_zero(Answer&) { _mm_setcsr(_mm_getcsr() | 0x8040); }
void shorten_x87(Answer&) {
  std::uint16_t word;
  asm volatile("fnstcw %0" : "=m"(word));
  word = static_cast<std::uint16_t>(word & ~0x300);
  asm volatile("fldcw %0" : : "m"(word));
}
constexpr Deed disturbances[] = {round_upward, flush_to_zero, shorten_x87};
#else
constexpr Deed disturbances[] = {round_upward};
#endif

TEST(Isolated, ChangedControlsAreToldAndPutBack) {
  for (const Deed deed : disturbances) {
    const Hostile in_process(deed);
    const auto wrapped = hostile(deed);
    for (const Tracer* tracer :
         {static_cast<const Tracer*>(&in_process), static_cast<const Tracer*>(wrapped.get())}) {
      const auto bag = tracer->prepare(one);
      const FloatEnvironment before;
      expect_faults(*bag, rays_with({}), {});
      EXPECT_FALSE(bag->disturbed());
      expect_faults(*bag, rays_with({17}), {});
      EXPECT_TRUE(bag->disturbed());
      EXPECT_FALSE(before.restore());
    }
    const auto fresh = wrapped->prepare(one);  // by the same child
    expect_faults(*fresh, rays_with({}), {});
    EXPECT_FALSE(fresh->disturbed());
  }
}

TEST(Isolated, ControlsChangedByABagAreTold) {
  Bag two = one;
  two.triangles.push_back(one.triangles[0]);
  const auto tracer = hostile(round_upward);
  const auto bag = tracer->prepare(two);
  expect_faults(*bag, rays_with({}), {});
  EXPECT_TRUE(bag->disturbed());
}

TEST(Isolated, WorksUnderTheCallersControls) {
  const auto tracer = hostile([](Answer& answer) { answer.t = std::fegetround(); });
  const auto bag = tracer->prepare(one);
  for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    const auto rays = rays_with({0}, 1);
    Answer answer;
    std::fesetround(mode);
    bag->trace(rays, {&answer, 1});
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(answer.t, mode);
  }
  EXPECT_FALSE(bag->disturbed());
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

std::size_t open_descriptors() {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
}

void answer_process(Answer& answer) { answer.t = getpid(); }
void answer_server(Answer& answer) { answer.t = getppid(); }

pid_t pid_from(PreparedBag& bag) {
  const auto rays = rays_with({0}, 1);
  Answer answer;
  bag.trace(rays, {&answer, 1});
  return static_cast<pid_t>(answer.t);
}

bool gone(pid_t process) {
  for (int tries = 0; tries < 1000; ++tries) {
    if (kill(process, 0) != 0) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

TEST(Isolated, AThousandBagsLeakNothing) {
  const std::size_t before = open_descriptors();
  {
    const auto tracer = hostile(abort_it);
    std::vector<std::unique_ptr<PreparedBag>> kept;
    std::size_t during = 0;
    for (std::size_t i = 0; i < 1000; ++i) {
      kept.push_back(tracer->prepare(one));
      if (i % 50 == 7) {
        expect_faults(*kept.back(), rays_with({2}, 4), {2});
      } else {
        expect_faults(*kept.back(), rays_with({}, 4), {});
      }
      if (i == 10) during = open_descriptors();
    }
    EXPECT_EQ(open_descriptors(), during);
    for (const auto& bag : kept) expect_faults(*bag, rays_with({}, 4), {});
    EXPECT_EQ(open_descriptors(), during);
  }
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
}

TEST(Isolated, BagsShareOneChildThatEndsWithTheTracer) {
  pid_t child = 0, server = 0;
  {
    const auto tracer = hostile(answer_process);
    child = pid_from(*tracer->prepare(one));
    for (int i = 0; i < 10; ++i) EXPECT_EQ(pid_from(*tracer->prepare(one)), child);
    EXPECT_NE(child, getpid());
    const auto other = hostile(answer_server);
    server = pid_from(*other->prepare(one));
    EXPECT_NE(server, getpid());
  }
  EXPECT_NE(kill(child, 0), 0);
  EXPECT_NE(kill(server, 0), 0);
}

// A signal takes its time.
bool replaced(PreparedBag& bag, pid_t killed) {
  for (int tries = 0; tries < 1000; ++tries) {
    const pid_t now = pid_from(bag);
    if (now != killed) return now > 0;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

TEST(Isolated, AChildOrAServerKilledByOthersCostsNoAnswer) {
  const auto tracer = hostile(answer_process);
  const auto bag = tracer->prepare(one);
  const pid_t child = pid_from(*bag);
  kill(child, SIGKILL);
  expect_faults(*bag, rays_with({}), {});
  EXPECT_TRUE(replaced(*bag, child));
  EXPECT_THAT(bag->conduct().deaths, IsEmpty());

  const auto orphan = hostile(answer_server);
  const auto other = orphan->prepare(one);
  const pid_t server = pid_from(*other);
  kill(server, SIGKILL);
  expect_faults(*other, rays_with({}), {});
  EXPECT_TRUE(replaced(*other, server));
  EXPECT_THAT(other->conduct().deaths, IsEmpty());
}

TEST(Isolated, NoChildOutlivesUsHoweverWeEnd) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t user = fork();
  ASSERT_GE(user, 0);
  if (user == 0) {
    const auto tracer = isolated(std::make_unique<Hostile>(+[](Answer& answer) {
      static bool told = false;
      if (told) hang(answer);
      told = true;
      answer.t = getpid();
    }));
    const auto bag = tracer->prepare(one);
    const pid_t child = pid_from(*bag);
    if (write(ends[1], &child, sizeof child) < 0) _exit(1);
    pid_from(*bag);  // hangs
    _exit(0);
  }
  pid_t child = 0;
  ASSERT_EQ(read(ends[0], &child, sizeof child), static_cast<ssize_t>(sizeof child));
  close(ends[0]);
  close(ends[1]);
  EXPECT_EQ(kill(child, 0), 0);
  kill(user, SIGKILL);
  waitpid(user, nullptr, 0);
  EXPECT_TRUE(gone(child));
}

TEST(Isolated, ManyThreadsAtATime) {
  const auto tracer = hostile(abort_it);
  std::vector<std::jthread> threads;
  for (std::size_t thread = 0; thread < 6; ++thread)
    threads.emplace_back([&tracer, thread] {
      for (std::size_t i = 0; i < 40; ++i) {
        const auto bag = tracer->prepare(one);
        if (i % 10 == thread) {
          expect_faults(*bag, rays_with({i}), {i});
        } else {
          expect_faults(*bag, rays_with({}), {});
        }
      }
    });
}

TEST(Isolated, LivesOnWhenTheThreadThatBeganEnds) {
  const auto tracer = hostile(answer_process);
  pid_t child = 0;
  std::jthread([&] { child = pid_from(*tracer->prepare(one)); }).join();
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(pid_from(*tracer->prepare(one)), child);
}

TEST(Isolated, SaysSoAndNothingElse) {
  const auto tracer = hostile(deny, true);
  EXPECT_EQ(tracer->info().isolation, Isolation::process);
  EXPECT_EQ(tracer->info().name, "hostile");
  EXPECT_TRUE(tracer->info().own_queries);
}

TEST(Conduct, ComplainsInWholeSentences) {
  EXPECT_EQ(complaints("x", {}), "");
  EXPECT_EQ(complaints("x", {.deaths = {{"SIGABRT", 1}}}), "x: died of 1 ray (SIGABRT); it is a fault\n");
  EXPECT_EQ(complaints("x", {.disturbed = true, .deaths = {{"SIGABRT", 3}}}),
            "x: died of 3 rays (SIGABRT); these are faults\nx: left the floating-point controls changed\n");
  EXPECT_EQ(complaints("x", {.deaths = {{"SIGABRT", 2}, {"exit code 0", 1}}}),
            "x: died of 3 rays (SIGABRT: 2, exit code 0: 1); these are faults\n");
  EXPECT_EQ(complaints("x", {.breaches = {{"lies", 1}, {"steals", 3}}}), "x: lies\nx: steals (3 times)\n");
}

TEST(Conduct, AddsUp) {
  Conduct sum{.deaths = {{"SIGABRT", 1}}, .breaches = {{"lies", 1}}};
  sum += {.disturbed = true, .deaths = {{"SIGABRT", 2}, {"SIGFPE", 4}}, .breaches = {{"lies", 2}}};
  sum += {};
  EXPECT_EQ(sum, (Conduct{
                     .disturbed = true, .deaths = {{"SIGABRT", 3}, {"SIGFPE", 4}}, .breaches = {{"lies", 3}}}));
}

}  // namespace
}  // namespace plumbline
