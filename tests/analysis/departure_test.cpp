#include "analysis/departure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "analysis/tracers.h"
#include "tests/analysis/fixed_tracer.h"

namespace plumbline {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

// Half way up the binade of 1, so that an ulp is the same above and below. Its front is +z.
const Triangle flat{{0, 0, 0x1.8p+0}, {1, 0, 0x1.8p+0}, {0, 1, 0x1.8p+0}};
const Ray down{{0x1p-2, 0x1p-2, 0x1.4p+1}, {0, 0, -1}};  // t = 1, u = v = 1/4
const std::vector<Vec3> both = {{0, 0, 1}, {0, 0, -1}};

double ulp(Precision p) { return p == Precision::binary32 ? 0x1p-23 : 0x1p-52; }

// Answers the first ray as the plan says, and leaving rays as a function of their origin's height in ulps.
class Planted final : public Tracer {
 public:
  using Hits = std::function<bool(const Ray&, double height)>;
  Planted(Answer arrival, Hits hits, const Contract& contract = {})
      : Tracer({.name = "planted", .summary = "", .source = "", .contract = contract}),
        arrival_(arrival),
        hits_(std::move(hits)) {}

  std::unique_ptr<PreparedBag> prepare(const Bag&) const override {
    struct Prepared final : PreparedBag {
      explicit Prepared(const Planted& p) : planted(p) {}
      void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
          const double height = (rays[i].origin.z - flat.a.z) / ulp(planted.info().contract.precision);
          answers[i] = rays[i] == down ? planted.arrival_ : Answer{};
          if (!(rays[i] == down) && planted.hits_(rays[i], height)) answers[i] = hit_at(-height);
        }
      }
      const Planted& planted;
    };
    return std::make_unique<Prepared>(*this);
  }

 private:
  Answer arrival_;
  Hits hits_;
};

Departures left(const Tracer& tracer, const std::vector<Vec3>& directions = both, const Triangle& triangle = flat,
                const Ray& ray = down) {
  Bag bag;
  bag.triangles = {triangle};
  return depart(tracer, *tracer.prepare(bag), triangle, ray, directions);
}

const Need& moved(const Departure& d) { return d.need[static_cast<std::size_t>(Remedy::origin)]; }
const Need& later(const Departure& d) { return d.need[static_cast<std::size_t>(Remedy::t_min)]; }

TEST(Departure, FromAPointInThePlaneTakesOneUlp) {
  const Departures d = left(find_tracer("exact"));
  EXPECT_EQ(d.arrival, Outcome::hit);
  ASSERT_EQ(d.list.size(), 6u);  // three points, both sides
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(d.list[i].point, static_cast<HitPoint>(i / 2));
    EXPECT_EQ(d.list[i].ray, (Ray{{0x1p-2, 0x1p-2, 0x1.8p+0}, both[i % 2]}));
    EXPECT_EQ(d.list[i].truth, Return::start);
    EXPECT_TRUE(d.list[i].hit);
    for (const Need& need : d.list[i].need) {
      EXPECT_EQ(need.tracer, 1);
      EXPECT_EQ(need.exact, 1);
    }
  }
}

TEST(Departure, ATracerThatIsOffIsToldByHowMuch) {
  for (const Precision precision : {Precision::binary32, Precision::binary64})
    for (const double off : {0.0, 1.0, 2.0, 3.0, 7.0, 8.0, 1000.0, 0x1p+20 - 1, 0x1p+20}) {
      const Planted tracer(hit_at(1, 0x1p-2, 0x1p-2), [off](const Ray&, double h) { return std::abs(h) <= off; },
                           {.precision = precision});
      for (const Departure& d : left(tracer).list) {
        EXPECT_EQ(moved(d).tracer, off + 1) << name(precision) << ' ' << off;
        EXPECT_EQ(moved(d).exact, 1);
        EXPECT_EQ(d.truth, Return::start);
        EXPECT_TRUE(d.hit);
        EXPECT_EQ(later(d).tracer, inf);  // it doesn't look at t_min
        EXPECT_EQ(later(d).exact, 1);
      }
    }
}

TEST(Departure, ATracerThatReadsTMinIsToldHowMuchOfIt) {
  const Planted tracer(hit_at(1), [](const Ray& r, double) { return r.t_min < 0x1.cp-50; });  // 7 ulps of 1
  for (const Departure& d : left(tracer).list) EXPECT_EQ(later(d).tracer, 7);
}

TEST(Departure, APointBehindThePlaneIsThePointsFault) {
  // t is late by 5 ulps of the point: up, the ray really meets the triangle again; down, it doesn't.
  const Planted tracer(hit_at(1 + 0x1.4p-50), [](const Ray& r, double h) { return h * r.direction.z <= 0; });
  const Departures d = left(tracer);
  ASSERT_EQ(d.list.size(), 4u);  // no u and v are told
  EXPECT_EQ(d.list[0].truth, Return::beyond);
  EXPECT_TRUE(d.list[0].hit);
  EXPECT_EQ(moved(d.list[0]).tracer, 6);
  EXPECT_EQ(moved(d.list[0]).exact, 6);
  EXPECT_EQ(later(d.list[0]).exact, 6);
  EXPECT_EQ(d.list[1].truth, Return::none);
  EXPECT_FALSE(d.list[1].hit);
  EXPECT_EQ(moved(d.list[1]).tracer, 0);
  EXPECT_EQ(moved(d.list[1]).exact, 0);
  EXPECT_EQ(d.list[2].point, HitPoint::rounded);
  EXPECT_EQ(d.list[2].truth, Return::start);
}

TEST(Departure, AHitWhereTheTruthHasNoneIsTheTracersFault) {
  const Planted tracer(hit_at(1 - 0x1p-50), [](const Ray&, double h) { return h < 100; });
  const Departure up = left(tracer).list[0];  // from 4 ulps above
  EXPECT_EQ(up.truth, Return::none);
  EXPECT_TRUE(up.hit);
  EXPECT_EQ(moved(up).tracer, 96);
  EXPECT_EQ(moved(up).exact, 0);
}

TEST(Departure, TheLastPowerOfTwoThatIsHitCounts) {
  // 8 alone of the powers, from 5 to 9: no longer hit from 10 on. And what is hit everywhere has no end.
  const Planted tracer(hit_at(1), [](const Ray&, double h) { return h >= 5 && h <= 9; });
  const Departures d = left(tracer);
  EXPECT_FALSE(d.list[0].hit);
  EXPECT_EQ(moved(d.list[0]).tracer, 10);
  EXPECT_EQ(moved(d.list[1]).tracer, 0);
  const Planted always(hit_at(1), [](const Ray&, double) { return true; });
  EXPECT_EQ(moved(left(always).list[0]).tracer, inf);
  const double most = std::ldexp(1.0, last_power(Precision::binary64));
  const Planted last(hit_at(1), [most](const Ray&, double h) { return h < most; });
  EXPECT_EQ(moved(left(last).list[0]).tracer, most);
}

TEST(Departure, TheEndOfTheRangeIsTheContracts) {
  for (const auto& [end, exact] : {std::pair(EndRule::closed, 1), {EndRule::open, 0}, {EndRule::unspecified, 0}}) {
    const Planted tracer(hit_at(1), [](const Ray&, double h) { return h == 0; }, {.t_min = end});
    for (const Departure& d : left(tracer).list) {
      EXPECT_EQ(d.truth, Return::start);
      EXPECT_TRUE(d.hit);
      EXPECT_EQ(moved(d).tracer, 1);
      EXPECT_EQ(moved(d).exact, exact);
    }
  }
}

TEST(Departure, OfALineTheCallerKeepsWhatIsAfterTheStart) {
  const Planted tracer(hit_at(1 + 0x1p-50), [](const Ray&, double) { return true; }, {.range = RangeRule::line});
  const Departures d = left(tracer);  // t = -height, whichever way the ray goes
  EXPECT_EQ(d.list[0].truth, Return::beyond);
  EXPECT_TRUE(d.list[0].hit);
  EXPECT_EQ(moved(d.list[0]).tracer, 4);  // at 4 ulps t is 0
  EXPECT_EQ(moved(d.list[0]).exact, 4);
  for (const Departure& each : d.list) {
    EXPECT_TRUE(std::isnan(later(each).tracer));
    EXPECT_TRUE(std::isnan(later(each).exact));
  }
}

TEST(Departure, WhatIsCulledNeedsNothing) {
  const Planted tracer(hit_at(1), [](const Ray&, double) { return false; }, {.culling = Culling::back});
  const Departures d = left(tracer);
  EXPECT_EQ(moved(d.list[0]).exact, 0);  // up, it would meet the back
  EXPECT_EQ(moved(d.list[1]).exact, 1);
  EXPECT_EQ(moved(d.list[1]).tracer, 0);
}

TEST(Departure, TruthIsOfWhatTheTracerIsAsked) {
  class Lower final : public Tracer {
   public:
    Lower() : Tracer({.name = "lower", .summary = "", .source = "", .contract = {}, .own_queries = true}) {}
    std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
      struct Prepared final : PreparedBag {
        explicit Prepared(const Bag& b) : exact(find_tracer("exact").prepare(b)) {}
        static Ray lower(Ray ray) { return ray.origin.z -= 0x1.8p-51, ray; }  // by 3 ulps
        Query asked(const Ray& ray) override { return lower(ray); }
        void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
          for (std::size_t i = 0; i < rays.size(); ++i) {
            const Ray put = lower(rays[i]);
            exact->trace({&put, 1}, {&answers[i], 1});
          }
        }
        std::unique_ptr<PreparedBag> exact;
      };
      return std::make_unique<Prepared>(bag);
    }
  };
  const Departures d = left(Lower());
  EXPECT_EQ(d.list[0].truth, Return::beyond);
  EXPECT_EQ(moved(d.list[0]).tracer, 4);
  EXPECT_EQ(moved(d.list[0]).exact, 4);
  EXPECT_EQ(d.list[1].truth, Return::none);
}

TEST(Departure, NoRayLeavesWhereThereIsNoPoint) {
  for (const double t : {inf, nan}) {
    const Planted tracer(hit_at(t, t, 0), [](const Ray&, double) { return false; });
    const Departures d = left(tracer);
    EXPECT_FALSE(d.finite);
    ASSERT_EQ(d.list.size(), 2u);
    EXPECT_EQ(d.list[0].point, HitPoint::rounded);
  }
  for (const Answer& arrival : {a_miss, Answer{.outcome = Outcome::fault}}) {
    const Departures d = left(Planted(arrival, [](const Ray&, double) { return true; }));
    EXPECT_EQ(d.arrival, arrival.outcome);
    EXPECT_TRUE(d.list.empty());
  }
}

TEST(Departure, ARayThatPassesBesideMeetsNothing) {
  // From 4 ulps behind the vertex A, sideways and up: beside the triangle.
  const Ray at_a{{0, 0, 0x1.4p+1}, {0, 0, -1}};
  const FixedTracer late({.answer = hit_at(1 + 0x1p-50)});
  const Departure d = left(late, {{-1, -1, 0x1p-4}}, flat, at_a).list[0];
  EXPECT_EQ(d.truth, Return::none);
  EXPECT_EQ(moved(d).exact, 5);  // moved by 4 ulps, it starts at the vertex
}

}  // namespace
}  // namespace plumbline
