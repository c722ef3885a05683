#include "analysis/bag_shrink.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/tracers.h"
#include "case/case_text.h"
#include "tests/analysis/faulty_tracer.h"
#include "tests/analysis/fixed_tracer.h"

namespace plumbline {
namespace {

// A sheet of n by n squares at z = 1, of two triangles each, and a ray at the point (x, y) of it.
Case sheet(int n, double x, double y) {
  Case what;
  what.id = "sheet";
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const double left = 0.3 * i, right = 0.3 * (i + 1), low = 0.7 * k, high = 0.7 * (k + 1);
      what.bag.triangles.push_back({{left, low, 1}, {right, low, 1}, {right, high, 1}});
      what.bag.triangles.push_back({{left, low, 1}, {right, high, 1}, {left, high, 1}});
    }
  }
  what.ray = {.origin = {x, y, -0.37}, .direction = {0, 0, 1.25}};
  return what;
}

TEST(BagShrink, LeavesWhatIsRight) { EXPECT_FALSE(shrink_bag(sheet(2, 0.1, 0.1), find_tracer("exact"))); }

TEST(BagShrink, FindsTheOneTriangleAndItsPlainForm) {
  const Faulty blind([](std::vector<Met>& met, std::size_t) { met.clear(); });
  const auto shrunk = shrink_bag(sheet(6, 0.65, 0.9), blind);
  ASSERT_TRUE(shrunk);
  EXPECT_EQ(to_word(*signature(shrunk->before)), "leak-interior");
  EXPECT_EQ(signature(shrunk->after), signature(shrunk->before));
  EXPECT_EQ(shrunk->what.bag.triangles.size(), 1u);
  EXPECT_LE(shrunk->bits_after, 12u);
  EXPECT_EQ(shrunk->bits_after, significant_bits(shrunk->what));
  EXPECT_GT(shrunk->bits_before, 1000u);
}

// What it takes to go wrong: a triangle nearer than another, both on the ray.
TEST(BagShrink, KeepsTheTwoThatItTakes) {
  const Faulty second([](std::vector<Met>& met, std::size_t) {
    if (met.size() > 1) met.erase(met.begin());
  });
  Case what = sheet(4, 0.65, 0.9);
  for (Triangle t : sheet(4, 0, 0).bag.triangles) {
    t.a.z = t.b.z = t.c.z = 2;
    what.bag.triangles.push_back(t);
  }
  const auto shrunk = shrink_bag(what, second);
  ASSERT_TRUE(shrunk);
  EXPECT_EQ(to_word(*signature(shrunk->after)), "wrong-nearest-interior-through-culling");
  EXPECT_EQ(shrunk->what.bag.triangles.size(), 2u);
  EXPECT_LE(shrunk->bits_after, 30u);
}

// Lost among more than eleven triangles: eleven are too few.
TEST(BagShrink, KeepsAsManyAsItTakes) {
  const Faulty crowded([](std::vector<Met>& met, std::size_t bag) {
    if (bag > 11) met.clear();
  });
  const auto shrunk = shrink_bag(sheet(6, 0.65, 0.9), crowded);
  ASSERT_TRUE(shrunk);
  EXPECT_EQ(to_word(*signature(shrunk->after)), "leak-interior-culling");
  EXPECT_EQ(shrunk->what.bag.triangles.size(), 12u);
}

// Vertices stay shared, and numbers the tracer's.
TEST(BagShrink, KeepsAPairTogether) {
  const Tracer& tracer = find_tracer("moller_trumbore_f32");
  std::size_t shrunk_pairs = 0;
  for (int i = 1; i < 400 && shrunk_pairs < 3; ++i) {
    Case what = sheet(1, 0.3 * i / 401, 0.7 * i / 401);
    what.ray.origin = {0.1 * i, 0.77, -0.37};
    what.ray.direction = {0.3 * i / 401 - 0.1 * i, 0.7 * i / 401 - 0.77, 1.37};
    const auto shrunk = shrink_bag(what, tracer);
    if (!shrunk) continue;
    EXPECT_EQ(signature(shrunk->after), signature(shrunk->before));
    EXPECT_LT(shrunk->bits_after, shrunk->bits_before);
    for (const Triangle& t : shrunk->what.bag.triangles)
      for (const Vec3& v : {t.a, t.b, t.c})
        for (const double x : {v.x, v.y, v.z}) ASSERT_TRUE(is_binary32(x));
    ++shrunk_pairs;
  }
  EXPECT_EQ(shrunk_pairs, 3u);
}

TEST(BagSignature, IsOneWord) {
  EXPECT_EQ(to_word({BagVerdict::leak, HitClass::edge, true, false}), "leak-edge-culling");
  EXPECT_EQ(to_word({BagVerdict::wrong_nearest, HitClass::interior, false, true}), "wrong-nearest-interior-through");
  EXPECT_EQ(to_word({BagVerdict::false_hit, HitClass::exterior, false, false}), "false-hit");
}

// Found on a jittered sphere: the nearer triangle is lost at an edge, the one behind is hit. Rounding one number at a
// time left 142 bits of it.
TEST(BagShrink, PutsTheRayBackOntoTheEdge) {
  const Case what = parse_cases(R"(
case wrong-nearest-interior-through
precision binary32
triangle 0x0p+0 0x1p+0 0x0p+0   0x0p+0 0x0p+0 0x0p+0   0x1p+0 0x0p+0 0x0p+0
triangle 0x0p+0 -0x1p-4 0x1p+0   0x0p+0 0x0p+0 0x0p+0   0x1.682p-6 0x1.23p-9 -0x1.05cp-4
ray -0x1.cc358p-1 -0x1.30076p+0 -0x1.3f19p-1   0x1.cdbcp-1 0x1.301b2p+0 0x1.3aaap-1
range 0x0p+0 inf
)",
                                "a pair")
                        .front();
  const auto shrunk = shrink_bag(what, find_tracer("moller_trumbore_f32"));
  ASSERT_TRUE(shrunk);
  EXPECT_EQ(to_word(*signature(shrunk->after)), "wrong-nearest-interior-through");
  EXPECT_EQ(shrunk->what.bag.triangles.size(), 2u);
  EXPECT_LE(shrunk->bits_after, 50u);
  EXPECT_GE(shrunk->after.judgement.ulps, 1024) << "it doesn't slip to two triangles an ulp apart";
}

// Each try may be a hang.
TEST(BagShrink, OfADeathTakesTrianglesAwayAlone) {
  const FixedTracer dies({.answer = {.outcome = Outcome::fault}, .conduct = {.deaths = {{"SIGABRT", 1}}}});
  const Case what = sheet(6, 0.65, 0.9);
  const auto shrunk = shrink_bag(what, dies);
  ASSERT_TRUE(shrunk);
  EXPECT_EQ(signature(shrunk->after), death_signature);
  EXPECT_EQ(shrunk->what.bag.triangles.size(), 1u);
  EXPECT_EQ(shrunk->what.ray, what.ray);
  EXPECT_LE(shrunk->tries, 20u);
}

}  // namespace
}  // namespace plumbline
