#include "analysis/bench/tracer_speed.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "analysis/tracers.h"

namespace plumbline {
namespace {

SpeedPlan plan_of(std::vector<const Tracer*> tracers) {
  return {.tracers = std::move(tracers), .rounds = 1, .slice_seconds = 1e-6, .memory_rays = 2000};
}

// Of a speed no test can say more than that there is one.
TEST(TracerSpeed, IsThereForEveryTracerAndWay) {
  std::vector<Shooting> told;
  const Speeds speeds = tracer_speeds(plan_of({&find_tracer("exact"), &find_tracer("woop_watertight_f32")}), false,
                                      [&told](Shooting way) { told.push_back(way); });
  ASSERT_EQ(speeds.size(), 2u);
  for (const auto& ways : speeds)
    for (std::size_t way = 0; way < shooting_names.size(); ++way) {
      EXPECT_GT(ways[way].ns, 0) << shooting_names[way];
      EXPECT_TRUE(ways[way].ratio > 0 && std::isfinite(ways[way].ratio)) << shooting_names[way];
    }
  EXPECT_EQ(told, (std::vector<Shooting>{Shooting::hits, Shooting::misses, Shooting::mixed, Shooting::single,
                                         Shooting::bags, Shooting::memory}));
}

// Notes what it is shot at.
class Recording final : public Tracer {
 public:
  Recording()
      : Tracer({.name = "recording", .summary = "", .source = "", .contract = find_tracer("exact").info().contract}) {}
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    struct Prepared final : PreparedBag {
      Prepared(const Bag& b, std::vector<std::size_t>& c, std::size_t& h)
          : calls(c), hits(h), exact(find_tracer("exact").prepare(b)) {}
      void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
        exact->trace(rays, answers);
        calls.push_back(rays.size());
        for (const Answer& a : answers) hits += a.outcome == Outcome::hit;
      }
      std::vector<std::size_t>& calls;
      std::size_t& hits;
      std::unique_ptr<PreparedBag> exact;
    };
    ++prepared;
    return std::make_unique<Prepared>(bag, calls, hits);
  }
  mutable std::size_t prepared = 0, hits = 0;
  mutable std::vector<std::size_t> calls;
};

TEST(TracerSpeed, TheWaysAreShotAtAsTheySay) {
  const Recording tracer;
  Shooting last = Shooting::hits;
  const auto check = [&] {
    std::size_t rays = 0;
    for (const std::size_t size : tracer.calls) rays += size;
    if (rays == 0) return;  // before the first
    const double share = static_cast<double>(tracer.hits) / static_cast<double>(rays);
    EXPECT_EQ(share, last == Shooting::hits ? 1 : last == Shooting::misses ? 0 : 0.5) << name(last);
    const bool one_by_one = last == Shooting::single || last == Shooting::bags;
    EXPECT_EQ(tracer.calls.front(), one_by_one ? 1u : last == Shooting::memory ? 2000u : 1024u) << name(last);
    EXPECT_EQ(tracer.prepared > 1, last == Shooting::bags) << name(last);
  };
  tracer_speeds(plan_of({&tracer}), false, [&](Shooting way) {
    check();
    EXPECT_EQ(tracer.calls.empty(), way == Shooting::hits);
    last = way;
    tracer.calls.clear();
    tracer.hits = 0;
    tracer.prepared = 1;
  });
  check();
  EXPECT_EQ(last, Shooting::memory);
}

TEST(TracerSpeed, StopsWhenItIsToldTo) {
  std::atomic<bool> stop = false;
  std::size_t ways = 0;
  EXPECT_THROW(tracer_speeds(plan_of({&find_tracer("exact")}), stop, [&](Shooting) { stop = ++ways == 2; }),
               std::runtime_error);
  EXPECT_EQ(ways, 2u);
}

}  // namespace
}  // namespace plumbline
