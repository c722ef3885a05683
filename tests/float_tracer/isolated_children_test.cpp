// The processes of isolated tracers: how many there are, that they end, and whom they outlive.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <iterator>
#include <thread>

#include "tests/float_tracer/hostile.h"

namespace plumbline {
namespace {

using namespace std::chrono_literals;
using testing::IsEmpty;

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

}  // namespace
}  // namespace plumbline
