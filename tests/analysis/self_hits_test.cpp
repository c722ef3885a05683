#include "analysis/self_hits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/self_hits_table.h"
#include "analysis/tracers.h"
#include "case/input_error.h"
#include "case/precision.h"
#include "oracle/classify.h"
#include "oracle/offset.h"

namespace plumbline {
namespace {

const std::vector<SelfHitFamily> all_families(self_hit_families.begin(), self_hit_families.end());

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// `exact`, with another contract, on a ray that a test may change before.
class Changed final : public Tracer {
 public:
  using Change = Ray (*)(const Triangle&, const Ray&);
  explicit Changed(const Contract& contract, Change change = [](const Triangle&, const Ray& ray) { return ray; })
      : Tracer({.name = "changed", .summary = "", .source = "", .contract = contract}), change_(change) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    struct Prepared final : PreparedBag {
      Prepared(const Bag& b, Change c)
          : triangle(b.triangles.front()), exact(find_tracer("exact").prepare(b)), change(c) {}
      void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
          const Ray put = change(triangle, rays[i]);
          exact->trace({&put, 1}, {&answers[i], 1});
        }
      }
      Triangle triangle;
      std::unique_ptr<PreparedBag> exact;
      Change change;
    };
    return std::make_unique<Prepared>(bag, change_);
  }

 private:
  Change change_;
};

TEST(SelfHits, OfAnExactTracerAreThePointsAlone) {
  const Changed single({.precision = Precision::binary32});
  const SelfHitResult result = measure_self_hits(
      {.tracers = {&find_tracer("exact"), &single}, .families = all_families, .rays = 60, .seed = 1, .jobs = 2});
  EXPECT_EQ(result.done, 2 * all_families.size());
  for (const auto& scores : result.scores)
    for (std::size_t f = 0; f < all_families.size(); ++f) {
      const SelfHitScore& score = scores[f];
      EXPECT_EQ(score.hits, 60u);
      EXPECT_EQ(score.misses + score.faults + score.not_finite, 0u);
      std::uint64_t beyond = 0;
      for (const auto& by_leaving : score.cells)
        for (const SelfHitCell& c : by_leaving) {
          EXPECT_EQ(c.rays, 120u);
          EXPECT_EQ(c.false_hits, 0u);
          EXPECT_EQ(c.beyond_hits, c.beyond);
          EXPECT_EQ(c.start_hits, c.start);  // its range is closed
          EXPECT_LE(c.beyond, 60u);          // of two opposite rays one goes away
          beyond += c.beyond;
          for (const NeedSpread& n : c.need) {
            EXPECT_EQ(n.tracer.count, 120u);
            EXPECT_EQ(n.tracer.median, n.exact.median) << all_families[f].name;
            EXPECT_EQ(n.tracer.p99, n.exact.p99);
            EXPECT_EQ(n.tracer.worst, n.exact.worst);
            EXPECT_EQ(n.excess.median, 0);
            EXPECT_EQ(n.excess.worst, 0);
          }
          EXPECT_EQ(c.need[0].nothing, c.rays - c.beyond - c.start);
        }
      EXPECT_GT(beyond, 100u) << all_families[f].name;
      // The rounded exact point is half an ulp beside the plane at most: in each coordinate, so that it may take 2.
      for (const SelfHitCell& c : score.cells[static_cast<std::size_t>(HitPoint::rounded)])
        EXPECT_LE(c.need[0].exact.worst, 2);
    }
}

TEST(SelfHits, WhatATracerIsOffIsItsExcess) {
  // 64 ulps further back than it is, as it sees itself.
  const Changed tracer({}, [](const Triangle& t, const Ray& ray) {
    Ray put = ray;
    const double side = classify(t, ray).det_sign, ulp = std::ldexp(1.0, std::ilogb(largest(ray.origin)) - 52);
    const double back = -64 * side * ulp;
    put.origin = moved_off(t, ray.origin, {&back, 1}, Precision::binary64).front();
    return put;
  });
  const SelfHitResult result =
      measure_self_hits({.tracers = {&tracer}, .families = {self_hit_families[0]}, .rays = 200});
  for (const SelfHitCell& c : result.scores[0][0].cells[static_cast<std::size_t>(HitPoint::rounded)]) {
    EXPECT_NEAR(c.need[0].excess.median, 64, 1);
    EXPECT_GT(c.false_hits, 150u);  // nearly all that aren't beyond: but for those that then pass beside it
    EXPECT_LE(c.need[0].exact.worst, 2);
  }
}

TEST(SelfHits, AnOpenRangeNeedsNothingInThePlane) {
  // Of its own contract: closed, it hits what starts in the plane, against the promise.
  const Changed open({.precision = Precision::binary32, .t_min = EndRule::open});
  const SelfHitResult result = measure_self_hits({.tracers = {&open}, .families = {all_families[3]}, .rays = 100});
  std::uint64_t start = 0;
  for (const auto& by_leaving : result.scores[0][0].cells)
    for (const SelfHitCell& c : by_leaving) {
      start += c.start;
      EXPECT_EQ(c.start_hits, c.start);
      EXPECT_EQ(c.need[0].nothing, c.rays - c.beyond - c.start);
      EXPECT_LE(c.need[0].exact.worst, c.need[0].tracer.worst);
    }
  EXPECT_GT(start, 0u);  // 2^20 away a binary32 point is a multiple of 2^-4
}

TEST(SelfHits, RaysLeaveToBothSides) {
  for (const Precision precision : {Precision::binary32, Precision::binary64})
    for (const SelfHitFamily& family : all_families)
      for (std::uint64_t index = 0; index < 50; ++index) {
        const Shot shot = draw(family.dial, family.setting, precision, 3, index);
        if (!crosses(classify(shot.triangle, shot.ray))) continue;
        const auto rays = leaving_rays(shot, precision, 3, index);
        ASSERT_EQ(rays.size(), 4u);
        for (std::size_t i = 0; i < 4; ++i) {
          EXPECT_EQ(rays[i].kind, i < 2 ? Leaving::steep : Leaving::grazing);
          EXPECT_EQ(rays[i].direction, at_precision(rays[i].direction, precision));
          EXPECT_EQ(std::ilogb(largest(rays[i].direction)), std::ilogb(largest(shot.ray.direction)));
        }
        for (const std::size_t i : {0u, 2u}) {
          const int side = classify(shot.triangle, Ray{shot.ray.origin, rays[i].direction}).det_sign;
          EXPECT_NE(side, 0);
          EXPECT_EQ(classify(shot.triangle, Ray{shot.ray.origin, rays[i + 1].direction}).det_sign, -side);
        }
        EXPECT_NE(leaving_rays(shot, precision, 4, index)[0].direction, rays[0].direction);
        EXPECT_EQ(leaving_rays(shot, precision, 3, index)[0].direction, rays[0].direction);
      }
}

TEST(SelfHits, AResultIsTheSameForAnyNumberOfThreads) {
  SelfHitPlan plan{
      .tracers = find_tracers({"moller_trumbore_f32", "woop_watertight_f64", "brlcad_bot_classic_kernel"}),
      .families = all_families,
      .rays = 20};
  const auto all = [](const SelfHitResult& r) { return self_hits_csv(r) + to_terminal(r); };
  const std::string alone = all(measure_self_hits(plan));
  plan.jobs = 5;
  EXPECT_EQ(all(measure_self_hits(plan)), alone);
  plan.seed = 2;
  EXPECT_NE(all(measure_self_hits(plan)), alone);
}

TEST(SelfHits, TablesHoldWhatWasMeasured) {
  const SelfHitResult result = measure_self_hits({.tracers = find_tracers({"exact", "brlcad_bot_classic_kernel"}),
                                                  .families = {all_families[0]},
                                                  .rays = 20});
  const std::string csv = self_hits_csv(result), text = to_terminal(result);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 3 * 2 + 2 * 2);  // BRL-CAD's kernel tells no u and v
  EXPECT_NE(csv.find("\nexact,binary64,near,20,0,0,0,t,steep,40,"), std::string::npos);
  // Three tables; it isn't in the last either: it reads no t_min.
  EXPECT_EQ(std::ranges::count(text, '\n'), (2 + 5) + 3 + (2 + 5) + 3 + (2 + 2));
  EXPECT_NE(text.find("\nexact                      rounded    80"), std::string::npos);
}

TEST(SelfHits, NothingToDoIsAnError) {
  const Tracer* exact = &find_tracer("exact");
  EXPECT_THROW(measure_self_hits({}), InputError);
  EXPECT_THROW(measure_self_hits({.tracers = {exact}, .families = {}}), InputError);
  EXPECT_THROW(measure_self_hits({.tracers = {exact}, .families = all_families, .rays = 0}), InputError);
  EXPECT_THROW(measure_self_hits({.tracers = {exact, exact}, .families = all_families}), InputError);
}

TEST(SelfHits, StoppedItTellsWhatIsDone) {
  std::atomic<bool> stop = false;
  const SelfHitResult result =
      measure_self_hits({.tracers = {&find_tracer("exact")}, .families = all_families, .rays = 5}, stop,
                        [&stop](std::uint64_t done, std::uint64_t) { stop = done == 2; });
  EXPECT_EQ(result.done, 2u);
  EXPECT_EQ(result.scores[0][1].hits, 5u);
  EXPECT_EQ(result.scores[0][2].hits, 0u);
  EXPECT_EQ(std::ranges::count(self_hits_csv(result), '\n'), 1 + 2 * 6);
}

}  // namespace
}  // namespace plumbline
