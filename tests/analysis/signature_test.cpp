// What makes two findings the same: every kind, element and condition by hand, and words and keys that tell all
// apart.
#include "analysis/signature.h"

#include <gtest/gtest.h>

#include <cctype>
#include <limits>
#include <set>

#include "analysis/tracers.h"
#include "tests/analysis/fixed_tracer.h"

namespace plumbline {

void PrintTo(const Signature& s, std::ostream* out) { *out << to_word(s); }
void PrintTo(Element e, std::ostream* out) { *out << name(e); }
void PrintTo(Conditioning c, std::ostream* out) { *out << name(c); }

namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
constexpr double step = 0x1p-12;
const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
Ray down(double x, double y) { return {.origin = {x, y, 0x1p+3}, .direction = {0, 0, -0x1p+1}}; }
Ray up(double x, double y) { return {.origin = {x, y, -0x1p+3}, .direction = {0, 0, 0x1p+1}}; }
Ray within(Ray ray, double t_min, double t_max) {
  ray.t_min = t_min, ray.t_max = t_max;
  return ray;
}

Examination examined(const FixedAnswer& fixed, const Triangle& triangle, const Ray& ray,
                     const Contract& contract = {}) {
  const FixedTracer tracer(fixed, contract);
  return Examiner(tracer).examine(triangle, ray);
}
std::optional<Signature> of(const FixedAnswer& fixed, const Triangle& triangle, const Ray& ray,
                            const Contract& contract = {}) {
  return signature(examined(fixed, triangle, ray, contract));
}

TEST(Signature, NothingToFind) {
  EXPECT_EQ(of({hit_at(0x1p+2, 0x1p-2, 0x1p-2)}, flat, down(1, 1)), std::nullopt);
  EXPECT_EQ(of({a_hit}, flat, down(1, 1)), std::nullopt);
  EXPECT_EQ(of({a_miss}, flat, down(-1, 1)), std::nullopt);
  EXPECT_EQ(of({a_miss}, flat, down(2, 0), {.edges = EdgeRule::unspecified}), std::nullopt);
  EXPECT_EQ(of({{.outcome = Outcome::fault}}, flat, down(1, 1)), std::nullopt);
  EXPECT_EQ(of({a_hit}, flat, down(nan, 1)), std::nullopt);
}

TEST(Signature, FalseHitsByWhatTheLinePasses) {
  struct {
    Ray ray;
    Element element;
  } const list[] = {{down(1, -step), Element::ab},
                    {down(2 + step, 2), Element::bc},
                    {down(-step, 1), Element::ca},
                    {down(-1, -1), Element::a},
                    {down(6, -1), Element::b},
                    {down(-1, 6), Element::c},
                    {{.origin = {1, 1, 8}, .direction = {1, 0, 0}}, Element::plane},
                    {within(down(1, 1), 0x1.4p+2, inf), Element::t_min},
                    {within(down(1, 1), 0, 0x1.8p+1), Element::t_max},
                    {within(down(1, -step), 0, 0x1.8p+1), Element::ab}};
  for (const auto& [ray, element] : list) {
    const auto s = of({a_hit}, flat, ray);
    ASSERT_TRUE(s.has_value());
    EXPECT_EQ(s->kind, FindingKind::false_hit);
    EXPECT_EQ(s->element, element);
    EXPECT_FALSE(s->boundary);
    EXPECT_FALSE(s->lucky);
    EXPECT_EQ(s->rejection, Rejection::none);
  }
  EXPECT_EQ(of({a_hit}, flat, up(1, -step))->element, Element::ab);  // from behind
}

TEST(Signature, FalseMissesByWhatIsNearest) {
  struct {
    Ray ray;
    Element element;
    bool boundary;
  } const list[] = {{down(1, step), Element::ab, false},
                    {down(2 - step, 2 - step), Element::bc, false},
                    {down(step, 1), Element::ca, false},
                    {{.origin = {1, 1, step}, .direction = {0, 0, -2}}, Element::t_min, false},
                    {within(down(1, 1), 0, 0x1p+2 + step), Element::t_max, false},
                    {down(2, 0), Element::ab, true},
                    {down(2, 2), Element::bc, true},
                    {down(0, 2), Element::ca, true},
                    {down(0, 0), Element::a, true},
                    {down(4, 0), Element::b, true},
                    {down(0, 4), Element::c, true},
                    {within(down(1, 1), 0x1p+2, inf), Element::t_min, true},
                    {within(down(1, 1), 0, 0x1p+2), Element::t_max, true}};
  for (const auto& [ray, element, boundary] : list) {
    const auto s = of({a_miss, Rejection::t}, flat, ray);
    ASSERT_TRUE(s.has_value());
    EXPECT_EQ(s->kind, FindingKind::false_miss);
    EXPECT_EQ(s->element, element);
    EXPECT_EQ(s->boundary, boundary);
    EXPECT_EQ(s->rejection, Rejection::t);
  }
}

TEST(Signature, ElementsFollowTheVertexOrder) {
  const auto& [a, b, c] = flat;
  EXPECT_EQ(of({a_hit}, {b, c, a}, down(1, -step))->element, Element::ca);
  EXPECT_EQ(of({a_hit}, {b, a, c}, down(1, -step))->element, Element::ab);
  EXPECT_EQ(of({a_miss}, {c, a, b}, down(1, step))->element, Element::bc);
}

TEST(Signature, HitsOnAnOpenBoundary) {
  const auto s = of({a_hit}, flat, down(2, 0), {.edges = EdgeRule::open});
  ASSERT_TRUE(s.has_value());
  EXPECT_EQ(s->kind, FindingKind::false_hit);
  EXPECT_TRUE(s->boundary);
}

// A hit that is one, but a number of it isn't; those that aren't given don't count.
TEST(Signature, NotFinite) {
  for (const double bad : {inf, -inf, nan})
    for (const Answer& answer :
         {hit_at(bad), hit_at(bad, 0x1p-2, 0x1p-2), hit_at(0x1p+2, bad, 0x1p-2), hit_at(0x1p+2, 0x1p-2, bad)}) {
      const auto s = of({answer}, flat, down(1, 1));
      ASSERT_TRUE(s.has_value());
      EXPECT_EQ(s->kind, FindingKind::not_finite);
      EXPECT_EQ(s->element, Element::none);
    }
  EXPECT_EQ(of({{.outcome = Outcome::hit, .t = nan, .u = nan}}, flat, down(1, 1)), std::nullopt);
  EXPECT_EQ(of({hit_at(nan)}, flat, down(-1, 1))->kind, FindingKind::false_hit);
}

TEST(Signature, Death) {
  const Conduct died{.disturbed = false, .deaths = {{"SIGABRT", 1}}};
  const auto s = of({.answer = {.outcome = Outcome::fault}, .conduct = died}, flat, down(1, 1));
  ASSERT_TRUE(s.has_value());
  EXPECT_EQ(s->kind, FindingKind::death);
  EXPECT_EQ(to_word(*s), "death-nominal-c0");
  EXPECT_EQ(of({.answer = {.outcome = Outcome::fault}, .conduct = died}, flat, down(nan, 1))->kind,
            FindingKind::death);
}

// ---- conditions

struct Condition {
  Triangle triangle;
  Ray ray;
  Conditioning conditioning;
  int bucket;
};

// Of the 2-4 triangles: the least altitude over the longest edge is 1/2, the longest edge over 8 is 2^-1/2.
TEST(Signature, Conditions) {
  const auto slanting = [](double z) { return Ray{.origin = {-9, 1, 8 * z}, .direction = {1, 0, -z}}; };
  const auto thin = [](double height) { return Triangle{{0, 0, 0}, {4, 0, 0}, {0, height, 0}}; };
  const auto far = [](double x) { return Triangle{{x, 0, 0}, {x - 4, 0, 0}, {x - 2, 2, 0}}; };  // longest edge 4
  const Condition list[] = {
      {flat, down(-1, 1), Conditioning::nominal, 0},
      {flat, slanting(0x1p-4), Conditioning::nominal, 0},
      {flat, slanting(0x1p-6), Conditioning::nominal, 1},
      {flat, slanting(0x1p-9), Conditioning::nominal, 1},
      {flat, slanting(0x1p-11), Conditioning::grazing, 2},
      {flat, slanting(0x1p-19), Conditioning::grazing, 2},
      {flat, slanting(0x1p-21), Conditioning::grazing, 3},
      {flat, slanting(0x1p-39), Conditioning::grazing, 3},
      {flat, slanting(0x1p-41), Conditioning::grazing, 4},
      {flat, {.origin = {1, 1, 8}, .direction = {1, 0, 0}}, Conditioning::grazing, 4},
      {thin(0x1p-2), down(-1, 1), Conditioning::nominal, 0},
      {thin(0x1p-4), down(-1, 1), Conditioning::nominal, 1},
      {thin(0x1p-7), down(-1, 1), Conditioning::nominal, 1},
      {thin(0x1p-9), down(-1, 1), Conditioning::sliver, 2},
      {thin(0x1p-19), down(-1, 1), Conditioning::sliver, 3},
      {thin(0x1p-39), down(-1, 1), Conditioning::sliver, 4},
      {far(0x1.fep+6), down(-1, 1), Conditioning::nominal, 0},    // 4/127.5
      {far(0x1.02p+7), down(-1, 1), Conditioning::nominal, 1},    // 4/129
      {far(0x1.ffep+11), down(-1, 1), Conditioning::nominal, 1},  // 4/4095
      {far(0x1.001p+12), down(-1, 1), Conditioning::far, 2},      // 4/4097
      {far(0x1p+21), down(-1, 1), Conditioning::far, 2},
      {far(0x1p+23), down(-1, 1), Conditioning::far, 3},
      {flat, {.origin = {-1, 1, 0x1p+13}, .direction = {0, 0, -1}}, Conditioning::far, 2},
  };
  int n = 0;
  for (const auto& [triangle, ray, conditioning, bucket] : list) {
    SCOPED_TRACE(n++);
    const auto s = of({a_hit}, triangle, ray);
    ASSERT_TRUE(s.has_value());
    EXPECT_EQ(s->conditioning, conditioning);
    EXPECT_EQ(int{s->bucket}, bucket);
  }
}

// Hits of what is only touched, which nothing measures.
TEST(Signature, WithoutAConditionNumber) {
  const Triangle segment{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}};
  EXPECT_EQ(to_word(*of({a_hit}, segment, down(1, 1))), "false-hit-sliver-c4");
  EXPECT_EQ(to_word(*of({a_hit}, flat, {.origin = {-1, 1, 0}, .direction = {1, 0, 0}})), "false-hit-grazing-c4");
}

TEST(Signature, TheWorstConditionNames) {
  const Triangle thin{{0, 0, 0}, {4, 0, 0}, {0, 0x1p-14, 0}};
  const Ray slanting{.origin = {-8, 1, 0x1p-9}, .direction = {1, 0, -0x1p-12}};
  EXPECT_EQ(of({a_hit}, thin, slanting)->conditioning, Conditioning::sliver);
  const Ray flatter{.origin = {-8, 1, 0x1p-17}, .direction = {1, 0, -0x1p-20}};
  EXPECT_EQ(of({a_hit}, thin, flatter)->conditioning, Conditioning::grazing);
}

TEST(Signature, RangeComesBeforeTheCondition) {
  const Ray grazing{.origin = {-9, 1, 0x1p-9}, .direction = {1, 0, -0x1p-12}};
  for (const Ray& ray : {down(-1, 1), grazing}) {
    const int bucket = of({a_hit}, flat, ray)->bucket;
    const auto s = of({.answer = a_hit, .raised = FE_OVERFLOW}, flat, ray);
    EXPECT_EQ(s->conditioning, Conditioning::range);
    EXPECT_EQ(s->bucket, bucket);
  }
}

TEST(Signature, LuckyIsWhatTheAuthorWished) {
  const Examination hit = examined({a_hit}, flat, down(1, -step)), miss = examined({a_miss}, flat, down(1, step));
  EXPECT_TRUE(signature(hit, Wish::hit)->lucky);
  EXPECT_FALSE(signature(hit, Wish::miss)->lucky);
  EXPECT_FALSE(signature(hit, Wish::none)->lucky);
  EXPECT_TRUE(signature(miss, Wish::miss)->lucky);
  EXPECT_FALSE(signature(miss, Wish::hit)->lucky);
  EXPECT_FALSE(
      signature(examined({hit_at(nan)}, flat, down(1, 1)), Wish::hit)->lucky);  // a right answer is no luck
}

// The word and the bits of each field; severity is no part of it.
TEST(Signature, Words) {
  EXPECT_EQ(to_word(*of({a_hit}, flat, down(1, -step))), "false-hit-ab-nominal-c0");
  EXPECT_EQ(to_word(*of({a_hit}, flat, down(1, -2 * step))), "false-hit-ab-nominal-c0");
  EXPECT_EQ(to_word(*of({a_miss, Rejection::parallel}, flat, down(2, 0))),
            "false-miss-ab-by-parallel-exactly-nominal-c0");
  EXPECT_EQ(to_word(*of({hit_at(nan)}, flat, down(1, 1))), "not-finite-nominal-c0");
  EXPECT_EQ(to_word({FindingKind::false_miss, Element::t_min, Rejection::t, true, Conditioning::grazing, 3, true}),
            "false-miss-t_min-by-t-exactly-grazing-c3-lucky");
}

// A correctly rounded t of a triangle as small as t's ulp: no one can name the point better.
TEST(Signature, WhatRoundingOfTCannotHelpIsNotDisplaced) {
  const Triangle far{{0x1.dc7632eac28e3p+19, 0x1.17e5b9b0e0113p+9, 0x1.d1b9c776ae455p+17},
                     {0x1.dc7632eac2885p+19, 0x1.17e5b9b0f252dp+9, 0x1.d1b9c776ae299p+17},
                     {0x1.dc7632eac2817p+19, 0x1.17e5b9b101d5dp+9, 0x1.d1b9c776adfbbp+17}};
  const Ray ray{{-0x1.575f21527e306p+19, 0x1.a5f218184b904p+19, -0x1.d7a894e3ea316p+19},
                {0x1.7fdb523d27186p-1, -0x1.8add7444a3a0cp-2, 0x1.1359f7a4aae6p-1}};
  EXPECT_FALSE(signature(Examiner(find_tracer("exact")).examine(far, ray)));
  EXPECT_EQ(to_word(*of({hit_at(0x1.1162p+21)}, far, ray)), "displaced-plane-far-c4");
}

TEST(Signature, KeysAndWordsTellAllApart) {
  std::set<std::uint32_t> keys;
  std::set<std::string> words;
  std::size_t all = 0;
  for (unsigned kind = 0; kind < finding_kind_names.size(); ++kind)
    for (unsigned element = 0; element < element_names.size(); ++element)
      for (unsigned rejection = 0; rejection < rejection_names.size(); ++rejection)
        for (const bool boundary : {false, true})
          for (unsigned conditioning = 0; conditioning < conditioning_names.size(); ++conditioning)
            for (unsigned char bucket = 0; bucket <= 4; ++bucket)
              for (const bool lucky : {false, true}) {
                const Signature s{static_cast<FindingKind>(kind),
                                  static_cast<Element>(element),
                                  static_cast<Rejection>(rejection),
                                  boundary,
                                  static_cast<Conditioning>(conditioning),
                                  bucket,
                                  lucky};
                ++all;
                ASSERT_LT(s.key(), 1u << 19);
                keys.insert(s.key());
                const std::string word = to_word(s);
                for (const char c : word)  // it names files
                  ASSERT_TRUE(std::islower(c) || std::isdigit(c) || c == '-' || c == '_') << word;
                words.insert(word);
              }
  EXPECT_EQ(all, 70000u);
  EXPECT_EQ(keys.size(), all);
  EXPECT_EQ(words.size(), all);
}

}  // namespace
}  // namespace plumbline
