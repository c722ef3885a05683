#include "analysis/stability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "analysis/stability_table.h"
#include "analysis/tracers.h"
#include "case/input_error.h"
#include "float_tracer/kernel_tracer.h"
#include "oracle/measure.h"

namespace plumbline {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// Answers as `exact` does, but for what a test has it get wrong.
class Spoilt final : public Tracer {
 public:
  using Spoil = std::function<void(const Triangle&, const Ray&, Answer&)>;
  explicit Spoilt(Spoil spoil)
      : Tracer({.name = "spoilt", .summary = "", .source = "", .contract = find_tracer("exact").info().contract}),
        spoil_(std::move(spoil)) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    struct Prepared final : PreparedBag {
      Prepared(const Bag& b, const Spoil& s)
          : triangle(b.triangles.front()), exact(find_tracer("exact").prepare(b)), spoil(s) {}
      void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
        exact->trace(rays, answers);
        for (std::size_t i = 0; i < rays.size(); ++i) spoil(triangle, rays[i], answers[i]);
      }
      Triangle triangle;
      std::unique_ptr<PreparedBag> exact;
      const Spoil& spoil;
    };
    return std::make_unique<Prepared>(bag, spoil_);
  }

 private:
  Spoil spoil_;
};

StabilityResult measured(const Tracer& tracer, std::vector<Dial> dials, std::uint64_t cases = 100) {
  return measure_stability({.subjects = {{&tracer, Precision::binary64}}, .dials = std::move(dials), .cases = cases});
}

std::vector<Dial> all_dials() {
  std::vector<Dial> dials;
  for (std::size_t i = 0; i < dial_names.size(); ++i) dials.push_back(static_cast<Dial>(i));
  return dials;
}

TEST(Stability, OfTheExactTracerIsPerfect) {
  const StabilityResult result = measured(find_tracer("exact"), all_dials());
  std::uint64_t hits = 0;
  for (std::size_t d = 0; d < dial_names.size(); ++d)
    for (const StabilityCell& c : result.cells[0][d]) {
      hits += c.hits;
      EXPECT_EQ(c.false_misses + c.false_hits + c.not_finite, 0u) << dial_names[d];
      // A direction of 0: few bits draw the same point twice now and then.
      EXPECT_LE(c.faults, static_cast<Dial>(d) == Dial::lattice ? 3u : 0u) << dial_names[d];
      for (const Spread& s : {c.t, c.u, c.v}) EXPECT_LE(s.worst, 0.5) << dial_names[d];
      EXPECT_LE(c.backward.worst, 1) << dial_names[d];
    }
  EXPECT_GT(hits, 1000u);
  for (const auto& [asked, changed] : result.symmetries[0]) {
    EXPECT_GT(asked, 100u);
    EXPECT_EQ(changed, 0u);
  }
}

TEST(Stability, TheFamiliesAreAimedAsTheySay) {
  const StabilityResult result =
      measured(find_tracer("exact"), {Dial::lattice, Dial::parallel, Dial::near_edge, Dial::far});
  const auto& lattice = result.cells[0][0];
  EXPECT_GT(lattice.front().hits, 90u);  // of coordinates of 4 bits some make no triangle
  for (std::size_t i = 1; i < lattice.size(); ++i) EXPECT_EQ(lattice[i].hits, 100u);
  const auto& parallel = result.cells[0][1];
  for (std::size_t i = 2; i < parallel.size(); ++i) EXPECT_LE(parallel[i].hits, 5u);
  for (const StabilityCell& c : result.cells[0][2]) EXPECT_NEAR(static_cast<double>(c.hits), 50, 25);
  for (const StabilityCell& c : result.cells[0][3]) EXPECT_NEAR(static_cast<double>(c.hits), 30, 20);
  // Conditions grow with the dial: of far as 2^k.
  const auto& far = result.cells[0][3];
  EXPECT_GT(far.back().condition.median, far.front().condition.median * 0x1p+30);
}

TEST(Stability, ErrorsAreWhatWasSpoilt) {
  const Spoilt tracer([](const Triangle&, const Ray&, Answer& a) {
    a.t *= 1 + 0x1p-20;
    if (a.outcome == Outcome::hit) a.v = inf;
  });
  const auto cells = measured(tracer, {Dial::needle}).cells[0][0];
  EXPECT_NEAR(cells[0].t.median, 0x1.8p+32, 0x1p+32);  // 2^33 half ulps to 2^32 ulps
  EXPECT_EQ(cells[0].v.median, inf);
  EXPECT_EQ(cells[0].forward.worst, inf);
  EXPECT_EQ(cells[0].not_finite, cells[0].hits);
  EXPECT_EQ(cells[0].false_misses, 0u);
}

TEST(Stability, ABackwardErrorIsTheRelativeChangeThatWouldExplainIt) {
  // As if the direction were shorter by 2^-30: t is longer by that, and all the rest as it was.
  const Spoilt tracer([](const Triangle&, const Ray&, Answer& a) { a.t *= 1 + 0x1p-30; });
  const StabilityResult result = measured(tracer, {Dial::far, Dial::grazing});
  for (const auto& cells : result.cells[0])
    for (const StabilityCell& c : cells) {
      EXPECT_GT(c.backward.worst, 0);
      EXPECT_LE(c.backward.worst, 0x1p+23);
    }
}

TEST(Stability, AWrongDecisionHasTheSeverityAndTheChangeThatItTakes) {
  const Spoilt misses([](const Triangle&, const Ray&, Answer& a) { a = {}; });
  const Spoilt hits([](const Triangle&, const Ray&, Answer& a) { a = {.outcome = Outcome::hit}; });
  for (const Tracer* tracer : {static_cast<const Tracer*>(&misses), static_cast<const Tracer*>(&hits)}) {
    const auto cells = measured(*tracer, {Dial::near_edge}).cells[0][0];
    const auto at = settings(Dial::near_edge, Precision::binary64);
    EXPECT_EQ(cells[0].severity.count, cells[0].false_misses + cells[0].false_hits);
    EXPECT_GT(cells[0].severity.median, 0x1p+45);  // about the triangle's size
    for (std::size_t i = 1; at[i] <= 40; ++i)      // and by 2^-4 at each setting
      EXPECT_NEAR(std::log2(cells[i].severity.median / cells[i + 1].severity.median), 4, 2) << at[i];
    EXPECT_GT(cells[0].backward.worst, 0x1p+45);
  }
}

TEST(Stability, AnAbsoluteEpsilonChangesItsMindUnderScaling) {
  const Spoilt tracer([](const Triangle& t, const Ray&, Answer& a) {
    if (std::abs(t.a.x - t.b.x) < 1e-4) a = {};
  });
  const StabilityResult result = measured(tracer, {Dial::tiny});
  const auto changed = [&](Symmetry s) { return result.symmetries[0][static_cast<std::size_t>(s)].changed; };
  EXPECT_EQ(result.cells[0][0][0].false_misses, 0u);
  EXPECT_GT(result.cells[0][0][1].false_misses, 10u);
  EXPECT_GT(changed(Symmetry::scale), 0u);
  EXPECT_EQ(changed(Symmetry::direction), 0u);
}

TEST(Stability, AResultIsTheSameForAnyNumberOfThreads) {
  StabilityPlan plan{
      .subjects = subjects_of(find_tracers({"moller_trumbore_f32", "woop_watertight_f64", "woop_watertight_f64_fma"})),
      .dials = {Dial::grazing, Dial::lattice},
      .cases = 60};
  const auto all = [](const StabilityResult& r) {
    return cells_csv(r) + verdicts_csv(r) + symmetries_csv(r) + builds_csv(r) + conditions_csv(r) + to_terminal(r);
  };
  const std::string alone = all(measure_stability(plan));
  plan.jobs = 5;
  EXPECT_EQ(all(measure_stability(plan)), alone);
  EXPECT_NE(alone.find("woop_watertight_f64,woop_watertight_f64_fma,binary64,binary32,"), std::string::npos);
}

TEST(Stability, VerdictsAreByThe99thPercentileOfTheBackwardError) {
  std::vector<StabilityCell> cells(4);
  const std::vector<int> at = {0, 2, 4, 6};
  for (std::size_t i = 0; i < 4; ++i) {
    cells[i].backward.p99 = stable_bound;
    cells[i].forward.p99 = std::ldexp(1.0, static_cast<int>(3 * i));
  }
  EXPECT_TRUE(verdict(at, cells).stable);
  EXPECT_DOUBLE_EQ(verdict(at, cells).slope, 1.5);
  cells[2].backward.p99 = stable_bound * 1.001;
  cells[3].backward.p99 = inf;
  EXPECT_FALSE(verdict(at, cells).stable);
  EXPECT_EQ(verdict(at, cells).leaves_at, 4);
  cells[3].forward.p99 = inf;  // has no logarithm; a zero neither
  cells[0].forward.p99 = 0;
  EXPECT_DOUBLE_EQ(verdict(at, cells).slope, 1.5);
  EXPECT_EQ(verdict({}, {}).slope, 0);
}

TEST(Stability, NothingToDoIsAnError) {
  const Subject exact{&find_tracer("exact"), Precision::binary64};
  EXPECT_THROW(measure_stability({}), InputError);
  EXPECT_THROW(measure_stability({.subjects = {exact}, .dials = {}}), InputError);
  EXPECT_THROW(measure_stability({.subjects = {exact}, .dials = {Dial::far}, .cases = 0}), InputError);
  EXPECT_THROW(measure_stability({.subjects = {exact}, .dials = {Dial::far}}, true), std::runtime_error);
}

}  // namespace
}  // namespace plumbline
