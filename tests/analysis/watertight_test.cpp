#include "analysis/watertight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <set>

#include "analysis/tracers.h"
#include "analysis/watertight_table.h"
#include "case/input_error.h"
#include "oracle/judge.h"
#include "tests/analysis/faulty_tracer.h"

namespace plumbline {
namespace {

constexpr std::uint64_t few = 48;

LeakResult leaks_of(const Tracer& tracer, std::uint64_t rays = few, unsigned jobs = 2) {
  return find_leaks({.tracers = {&tracer}, .rays = rays, .jobs = jobs});
}

LeakScore score(const LeakResult& result, std::string_view test, Precision precision = Precision::binary32) {
  const auto tests = leak_tests();
  const auto it =
      std::ranges::find_if(tests, [&](const LeakTest& t) { return t.name == test && t.precision == precision; });
  return result.scores[0][static_cast<std::size_t>(it - tests.begin())];
}

void expect_nothing_wrong(const LeakResult& result) {
  for (std::size_t k = 0; k < leak_tests().size(); ++k) {
    const LeakScore& s = result.scores[0][k];
    EXPECT_EQ(s, LeakScore{.rays = result.plan.rays}) << leak_tests()[k].name << ' ' << name(leak_tests()[k].precision);
  }
}

TEST(Watertight, WhatIsRightIsToldSo) {
  expect_nothing_wrong(leaks_of(Faulty([](auto&, std::size_t) {})));
  expect_nothing_wrong(leaks_of(find_tracer("exact"), 200));
}

TEST(Watertight, TellsALeakAtEdges) {
  const Fault misses_edges = [](std::vector<Met>& met, std::size_t) {
    std::erase_if(met, [](const Met& m) { return m.truth.hit_class != HitClass::interior; });
  };
  const LeakResult result = leaks_of(Faulty(misses_edges));
  for (const char* test : {"pair, exact", "fan, exact"}) {
    const LeakScore& s = score(result, test);
    EXPECT_EQ(s, (LeakScore{.rays = few, .leaks = {few, few, 0}, .bag_leaks = {few, few, 0}})) << test;
  }
  Contract silent;
  silent.edges = EdgeRule::unspecified;
  const LeakScore excused = score(leaks_of(Faulty(misses_edges, silent)), "pair, exact");
  EXPECT_EQ(excused, (LeakScore{.rays = few, .leaks = {few, 0, 0}, .bag_leaks = {few, 0, 0}}));
}

// Pairs are lost, asked alone or not: by as much as the rays are inside.
TEST(Watertight, TellsALeakInsideOfATriangle) {
  Contract narrow;
  narrow.precision = Precision::binary32;
  const Faulty tracer(
      [](std::vector<Met>& met, std::size_t bag) {
        if (bag == 1 || bag == 2) met.clear();
      },
      narrow);
  const LeakResult result = leaks_of(tracer);
  const LeakScore& beside = score(result, "pair, ulp");
  EXPECT_EQ(beside.leaks.all, few);
  EXPECT_EQ(beside.bag_leaks, beside.leaks);
  EXPECT_GT(beside.leaks.worst, 0);
  EXPECT_LT(beside.leaks.worst, 8) << "they pass by an edge";
  EXPECT_EQ(beside.culled_leaks, 0u);
}

TEST(Watertight, TellsWrongCulling) {
  const Faulty tracer([](std::vector<Met>& met, std::size_t bag) {
    if (bag > 1) std::erase_if(met, [](const Met& m) { return m.triangle % 2 == 0; });
  });
  const LeakResult result = leaks_of(tracer);
  for (const char* test : {"pair, ulp", "sphere, vertices", "sphere, edges"}) {
    const LeakScore& s = score(result, test);
    EXPECT_EQ(s.leaks.all, 0u) << test;
    EXPECT_GT(s.bag_leaks.all, few / 8) << test;
    EXPECT_LT(s.bag_leaks.all, few) << test;
    EXPECT_EQ(s.culled_leaks, s.bag_leaks.all) << test;
    EXPECT_EQ(s.culled_nearest, s.nearest.all) << test;
  }
  const LeakScore& outside = score(result, "sphere, outside");
  EXPECT_GT(outside.nearest.all, 0u) << "it goes on to the other side";
  EXPECT_EQ(outside.culled_nearest, outside.nearest.all);
}

TEST(Watertight, TellsTheSecondNearest) {
  const Faulty tracer([](std::vector<Met>& met, std::size_t) {
    if (!met.empty() && met.back().t > met.front().t) met.erase(met.begin(), met.end() - 1);
  });
  const LeakScore& outside = score(leaks_of(tracer), "sphere, outside");
  EXPECT_EQ(outside.leaks.all, 0u);
  EXPECT_GT(outside.nearest.all, few / 2);
  EXPECT_EQ(outside.nearest.all, outside.nearest.broken);
  EXPECT_GT(outside.nearest.worst, 0x1p+20) << "a good part of the diameter";
  EXPECT_EQ(outside.culled_nearest, outside.nearest.all) << "it knew better of the triangles alone";
}

// Hits whatever it is asked alone: too many, and of parity at random.
TEST(Watertight, TellsDoubleHits) {
  const Faulty tracer([](std::vector<Met>& met, std::size_t bag) {
    if (bag == 1 && met.empty()) met.push_back({0, {}, 1});
  });
  const LeakResult result = leaks_of(tracer);
  const LeakScore& pair = score(result, "pair, ulp");
  EXPECT_GT(pair.doubles.all, few / 2);
  EXPECT_EQ(pair.doubles.broken, pair.doubles.all);
  EXPECT_GT(pair.doubles.worst, 0);
  EXPECT_EQ(pair.bag_leaks.all + pair.nearest.all + pair.false_hits.all, 0u);
  const LeakScore& sphere = score(result, "sphere, edges");
  EXPECT_GT(sphere.doubles.all, few / 2);
  EXPECT_GT(sphere.parity.broken, 0u);
}

// Another triangle than the one that is crossed, and just as near: no box is to blame.
TEST(Watertight, TellsDisplacedHits) {
  const Faulty tracer([](std::vector<Met>& met, std::size_t bag) {
    for (Met& m : met) m.triangle = static_cast<std::uint32_t>((m.triangle + 1) % bag);
  });
  const LeakScore& pair = score(leaks_of(tracer), "pair, ulp");
  EXPECT_GT(pair.nearest.all, few / 2);
  EXPECT_EQ(pair.culled_nearest, 0u);
}

// Alone, what is farther has the smaller t.
TEST(Watertight, TellsAWrongOrder) {
  const Faulty tracer([](std::vector<Met>& met, std::size_t bag) {
    for (Met& m : met) m.t = bag == 1 ? 10 - m.t : m.t;
  });
  const LeakResult result = leaks_of(tracer);
  const LeakScore& stack = score(result, "sheets");
  EXPECT_EQ(stack.order.all, few) << "of 3 sheets at least";
  EXPECT_EQ(stack.order.broken, few);
  EXPECT_GT(stack.order.worst, 0x1p+20);
  EXPECT_EQ(stack.leaks.all + stack.doubles.all + stack.nearest.all, 0u);
  EXPECT_EQ(score(result, "overlap").order.all, 0u) << "what is equally far is in order";
}

// One of several that are crossed is missing: a leak, though others are hit.
TEST(Watertight, TellsWhatIsMissingInAStack) {
  const Faulty tracer([](std::vector<Met>& met, std::size_t bag) {
    if (bag == 1 && !met.empty() && met[0].t < 1) met.clear();
  });
  EXPECT_GT(score(leaks_of(tracer), "sheets").leaks.all, few / 2);
}

TEST(Watertight, LatticeBagsAreFromAllOverIt) {
  class Keeps final : public Tracer {
   public:
    Keeps() : Tracer({.name = "keeps", .summary = "", .source = "", .contract = {}}) {}
    std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
      const auto of_lattice = [](double x) { return x == 0 || std::fabs(x) == 1; };
      const auto in_lattice = [&](const Vec3& v) { return of_lattice(v.x) && of_lattice(v.y) && of_lattice(v.z); };
      if (bag.triangles.size() == 2 && std::ranges::all_of(bag.triangles, [&](const Triangle& t) {
            return in_lattice(t.a) && in_lattice(t.b) && in_lattice(t.c);
          })) {
        const std::lock_guard lock(mutex);
        bags.push_back(bag.triangles);
      }
      struct Prepared final : PreparedBag {
        void answer(std::span<const Ray>, std::span<Answer>) override {}
      };
      return std::make_unique<Prepared>();
    }
    mutable std::mutex mutex;
    mutable std::vector<std::vector<Triangle>> bags;
  };
  const Keeps keeps;
  leaks_of(keeps, 400);
  ASSERT_EQ(keeps.bags.size(), 200u) << "of four rays each, in both precisions";
  using Point = std::array<double, 3>;
  std::set<std::set<Point>> edges;  // that are shared
  for (const auto& bag : keeps.bags) {
    const auto corners = [](const Triangle& t) {
      return std::set<Point>{{t.a.x, t.a.y, t.a.z}, {t.b.x, t.b.y, t.b.z}, {t.c.x, t.c.y, t.c.z}};
    };
    std::set<Point> edge = corners(bag[0]);
    std::erase_if(edge, [other = corners(bag[1])](const Point& p) { return !other.contains(p); });
    edges.insert(edge);
  }
  EXPECT_EQ(edges.size(), 100u) << "counted one by one, the first 300 bags would share one edge";
}

TEST(Watertight, WhatIsAskedIsJudged) {
  // It moves every ray far aside, and says so.
  class Aside final : public Tracer {
   public:
    Aside() : Tracer({.name = "aside", .summary = "", .source = "", .contract = {}, .own_queries = true}) {}
    std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
      struct Prepared final : PreparedBag {
        explicit Prepared(std::size_t n) : size(n) {}
        Query asked(const Ray& ray) override {
          Ray moved = ray;
          moved.origin.x += size == 1 && leaning ? 100 : 50;
          return moved;
        }
        void answer(std::span<const Ray>, std::span<Answer>) override {}
        std::size_t size;
        bool leaning = true;
      };
      return std::make_unique<Prepared>(bag.triangles.size());
    }
  };
  const LeakScore& s = score(leaks_of(Aside()), "pair, ulp");
  EXPECT_EQ(s, (LeakScore{.rays = few, .apart = few})) << "nothing is there, and alone it is asked something else";
}

// What its own lines cross has to be asked, though the rays given cross something else.
TEST(Watertight, LinesOfItsOwnAreAskedOfAllThatTheyCross) {
  class Shifted final : public Tracer {
   public:
    Shifted() : Tracer({.name = "shifted", .summary = "", .source = "", .contract = {}, .own_queries = true}) {}
    std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
      struct Prepared final : PreparedBag {
        explicit Prepared(const Bag& bag) : right(find_tracer("exact").prepare(bag)) {}
        static Ray shifted(Ray ray) {
          ray.origin.x += 0x1p-2;
          return ray;
        }
        Query asked(const Ray& ray) override { return shifted(ray); }
        void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
          std::vector<Ray> moved;
          for (const Ray& ray : rays) moved.push_back(shifted(ray));
          right->trace(moved, answers);
        }
        std::unique_ptr<PreparedBag> right;
      };
      return std::make_unique<Prepared>(bag);
    }
  };
  expect_nothing_wrong(leaks_of(Shifted()));
}

TEST(Watertight, FaultsAreNoLeaks) {
  class Mute final : public Tracer {
   public:
    Mute() : Tracer({.name = "mute", .summary = "", .source = "", .contract = {}}) {}
    std::unique_ptr<PreparedBag> prepare(const Bag&) const override {
      struct Prepared final : PreparedBag {
        void answer(std::span<const Ray>, std::span<Answer> answers) override {
          for (Answer& a : answers) a.outcome = Outcome::fault;
        }
      };
      return std::make_unique<Prepared>();
    }
  };
  EXPECT_EQ(score(leaks_of(Mute()), "fan, exact"), (LeakScore{.rays = few, .faults = few}));
}

TEST(Watertight, CountsDoNotDependOnJobs) {
  const Tracer& tracer = find_tracer("moller_trumbore_f32");
  const LeakResult one = leaks_of(tracer, 100, 1), three = leaks_of(tracer, 100, 3);
  EXPECT_EQ(one.scores, three.scores);
  EXPECT_GT(score(one, "pair, ulp").leaks.all, 0u) << "of those that tracers.md counted in thousands";
  EXPECT_NE(one.scores, find_leaks({.tracers = {&tracer}, .rays = 100, .seed = 2}).scores);
}

TEST(Watertight, Binary64InputsAreForThoseThatReadThem) {
  EXPECT_EQ(score(leaks_of(find_tracer("woop_watertight_f32")), "pair, exact", Precision::binary64).rays, 0u);
  EXPECT_EQ(score(leaks_of(find_tracer("woop_watertight_f64")), "pair, exact", Precision::binary64).rays, few);
}

TEST(Watertight, StoppedItTellsWhatIsDone) {
  std::atomic<bool> stop = false;
  const Tracer& tracer = find_tracer("woop_watertight_f32");
  const LeakResult result = find_leaks({.tracers = {&tracer}, .rays = few, .jobs = 1}, stop,
                                       [&](std::uint64_t done, std::uint64_t) { stop = done == 5; });
  EXPECT_EQ(result.done, 5u);
  EXPECT_GT(result.planned, 5u);
  std::uint64_t rays = 0;
  for (const LeakScore& s : result.scores[0]) rays += s.rays;
  EXPECT_EQ(rays, 5 * 16u) << "one of each of the first five tests";
}

TEST(Watertight, NothingToAsk) {
  EXPECT_THROW(find_leaks({}), InputError);
  const Tracer& exact = find_tracer("exact");
  EXPECT_THROW(find_leaks({.tracers = {&exact}, .rays = 0}), InputError);
  EXPECT_THROW(find_leaks({.tracers = {&exact, &exact}}), InputError);
}

TEST(WatertightTable, SaysWhatIsThereAndNoMore) {
  const Tracer& narrow = find_tracer("woop_watertight_f32");
  LeakResult result{.plan = {.tracers = {&narrow}, .rays = 10},
                    .scores = {std::vector<LeakScore>(leak_tests().size())},
                    .conduct = std::vector<Conduct>(1)};
  LeakScore& pair = result.scores[0][0];
  pair.rays = 10;
  pair.leaks = {.all = 3, .broken = 2, .worst = 0.5};
  pair.doubles = {.all = 4, .broken = 4, .worst = 1.5};
  const std::string table = to_terminal(result);
  EXPECT_NE(table.find("3/4"), std::string::npos) << table;
  EXPECT_NE(table.find("  by its contract          2/4"), std::string::npos) << table;
  EXPECT_EQ(table.find("binary64"), std::string::npos) << "no tracer reads them";
  const std::string csv = to_csv(result);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 2) << csv;
  EXPECT_NE(csv.find("woop_watertight_f32,binary32,\"pair, ulp\",10,3,2,0.5,4,4,1.5,0,0,0,"), std::string::npos) << csv;
}

}  // namespace
}  // namespace plumbline
