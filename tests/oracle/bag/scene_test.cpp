// The tree against every triangle asked: hits, ties, stretches, everything.
#include "oracle/bag/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "case/input_error.h"
#include "tests/judges/seed.h"
#include "tests/oracle/bag/bags.h"
#include "tests/oracle/float_environment.h"

namespace plumbline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool same(const BagTruth& x, const BagTruth& y) {
  const auto hit = [](const BagHit& p, const BagHit& q) {
    return p.triangle == q.triangle && p.rank == q.rank && p.truth == q.truth && p.owner == q.owner && p.t == q.t;
  };
  const auto stretch = [](const Stretch& p, const Stretch& q) {
    return p.triangle == q.triangle && p.hit_class == q.hit_class && p.low == q.low && p.high == q.high;
  };
  return x.invalid == y.invalid && x.on_surface == y.on_surface && std::ranges::equal(x.hits, y.hits, hit) &&
         std::ranges::equal(x.stretches, y.stretches, stretch);
}

struct Counts {
  std::uint64_t rays = 0, hits = 0, ties = 0, stretches = 0;
};

// The truth of the scene, and what it hits first, against bag_truth.
void check(const std::vector<Triangle>& bag, const std::vector<Query>& queries, Counts& counts) {
  const Scene scene(bag);
  NearestHits nearest;
  scene.nearest(queries, nearest);
  ASSERT_EQ(nearest.size(), queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const BagTruth truth = bag_truth(bag, queries[i]);
    ASSERT_TRUE(same(scene.truth(queries[i]), truth)) << "ray " << i;
    const auto owners = nearest.of(i);
    ASSERT_EQ(owners.size(), truth.nearest()) << "ray " << i;
    for (std::size_t k = 0; k < owners.size(); ++k) {
      ASSERT_EQ(owners[k].triangle, truth.hits[k].triangle) << "ray " << i;
      ASSERT_EQ(owners[k].truth, truth.hits[k].truth) << "ray " << i;
    }
    ++counts.rays;
    counts.hits += !truth.hits.empty();
    counts.ties += owners.size() > 1;
    counts.stretches += !truth.stretches.empty();
  }
}

void report(const Counts& c) {
  std::printf("seed %llu: %llu rays, %llu hits, %llu ties, %llu with stretches\n",
              static_cast<unsigned long long>(judges::seed()), static_cast<unsigned long long>(c.rays),
              static_cast<unsigned long long>(c.hits), static_cast<unsigned long long>(c.ties),
              static_cast<unsigned long long>(c.stretches));
}

TEST(Scene, OfLatticesIsTheBag) {
  LatticeBags draw(judges::seed(), 2);
  Counts counts;
  for (int round = 0; round < 400; ++round) {
    const auto bag = draw.bag(round % 40);
    std::vector<Query> queries;
    for (int i = 0; i < 25; ++i) {
      Ray ray = draw.ray();
      if (i % 5 == 0) ray.t_min = -infinity;
      if (i % 7 == 0) ray.t_min = ray.t_max = 1;
      queries.emplace_back(ray);
    }
    check(bag, queries, counts);
  }
  report(counts);
  EXPECT_GT(counts.hits, 2000u);
  EXPECT_GT(counts.ties, 300u);
  EXPECT_GT(counts.stretches, 300u);
}

// Full doubles over many binades, with components that are tiny, huge or zero, and tails.
TEST(Scene, OfSpreadDoublesIsTheBag) {
  std::mt19937_64 random(judges::seed());
  const auto number = [&](int binades) {
    const double significand = std::ldexp(static_cast<double>(random() >> 11), -53) * (random() % 2 ? 1 : -1);
    const int reach = 2 * binades + 1;
    return random() % 9 == 0 ? 0 : std::ldexp(significand, static_cast<int>(random() % reach) - binades);
  };
  Counts counts;
  for (const int binades : {1, 20, 300, 1015}) {
    for (int round = 0; round < 60; ++round) {
      const auto point = [&] { return Vec3{number(binades), number(binades), number(binades)}; };
      std::vector<Triangle> bag;
      for (int i = 0; i < 30; ++i) bag.push_back({point(), point(), point()});
      std::vector<Query> queries;
      for (int i = 0; i < 30; ++i) {
        const Triangle& aim = bag[random() % bag.size()];
        const Vec3 o = i % 3 == 0 ? Vec3{} : point();
        const Vec3 target = i % 4 == 0 ? aim.a : point();
        Query query(Ray{.origin = o, .direction = {target.x - o.x, target.y - o.y, target.z - o.z}});
        if (i % 5 == 0) query.ray.t_min = -infinity;
        if (i % 6 == 0) query.direction_tail.x = std::ldexp(query.ray.direction.x, -54);
        if (query.ray.direction == Vec3{}) query.ray.direction.z = 1;
        queries.push_back(query);
      }
      check(bag, queries, counts);
    }
  }
  report(counts);
  EXPECT_GT(counts.hits, 500u);
}

// Rays in the planes of boxes' faces and along their edges, where a test of boxes that is off by an ulp loses hits.
TEST(Scene, LosesNothingOnTheFacesOfBoxes) {
  std::vector<Triangle> bag;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (const Triangle& t : box({x * 0.1, y * 0.1, 0}, {(x + 1) * 0.1, (y + 1) * 0.1, 0.3})) bag.push_back(t);
  std::vector<Query> queries;
  for (int x = 0; x <= 4; ++x) {
    for (int y = 0; y <= 4; ++y) {
      queries.emplace_back(Ray{.origin = {x * 0.1, y * 0.1, -1}, .direction = {0, 0, 1}});
      queries.emplace_back(Ray{.origin = {x * 0.1, y * 0.1, -1}, .direction = {0, -0.0, 3}});
      queries.emplace_back(Ray{.origin = {x * 0.1, -1, y * 0.1}, .direction = {0, 0.7, 0}});
      queries.emplace_back(Ray{.origin = {-1, x * 0.1, y * 0.1}, .direction = {0.3, 0, 0}});
      queries.emplace_back(Ray{.origin = {x * 0.1 - 1, y * 0.1 - 1, -1}, .direction = {1, 1, 1}});
    }
  }
  Counts counts;
  check(bag, queries, counts);
  EXPECT_EQ(counts.hits + counts.stretches >= 100, true);
}

TEST(Scene, TakesManyEqualTriangles) {
  const std::vector<Triangle> bag(500, Triangle{{0, 0, 1}, {2, 0, 1}, {0, 2, 1}});
  const Scene scene(bag);
  NearestHits hits;
  scene.nearest(std::vector<Query>{Ray{.origin = {0.5, 0.5, 0}, .direction = {0, 0, 1}}}, hits);
  EXPECT_EQ(hits.of(0).size(), 500u);
}

TEST(Scene, TakesBoundsBeyondBinary32) {
  const double far = 0x1p+900;
  const std::vector<Triangle> bag = {{{-far, -far, far}, {far, -far, far}, {0, far, far}},
                                     {{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}},
                                     {{-0x1p-900, -0x1p-900, 1}, {0x1p-900, -0x1p-900, 1}, {0, 0x1p-900, 1}}};
  const Scene scene(bag);
  const BagTruth truth = scene.truth(Ray{.origin = {}, .direction = {0, 0, 1}});
  ASSERT_EQ(truth.hits.size(), 3u);
  EXPECT_EQ(truth.hits[0].triangle, 2u);
  EXPECT_EQ(truth.hits[2].t, far);
}

TEST(Scene, SaysWhichTriangleIsNotFinite) {
  std::vector<Triangle> bag(3, Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  bag[2].b.y = NAN;
  try {
    const Scene scene(bag);
    FAIL() << "taken";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "triangle 2 of the scene has a coordinate that is NaN or infinite");
  }
}

TEST(Scene, HasNoHitsOfInvalidQueries) {
  const Scene scene(std::vector<Triangle>{{{0, 0, 1}, {2, 0, 1}, {0, 2, 1}}});
  NearestHits hits;
  const Ray good{.origin = {0.5, 0.5, 0}, .direction = {0, 0, 1}};
  Ray bad = good;
  bad.direction = {};
  scene.nearest(std::vector<Query>{bad, good, bad}, hits);
  EXPECT_EQ(hits.of(0).size(), 0u);
  EXPECT_EQ(hits.of(1).size(), 1u);
  EXPECT_EQ(hits.of(2).size(), 0u);
  EXPECT_EQ(scene.truth(bad).invalid, Invalid::zero_direction);
  EXPECT_TRUE(Scene({}).truth(good).hits.empty());
}

TEST(Scene, IsTheSameInEveryEnvironment) {
  LatticeBags draw(judges::seed() + 1, 2);
  std::vector<Triangle> bag;
  while (bag.size() < 60) bag.push_back(draw.triangle());
  for (std::size_t i = 0; i < 20; ++i) {  // subnormal: a lattice of 2^-1070
    Triangle t = draw.triangle();
    for (Vec3* v : {&t.a, &t.b, &t.c}) *v = {v->x * 0x1p-1070, v->y * 0x1p-1070, v->z * 0x1p-1070};
    bag.push_back(t);
  }
  std::vector<Query> queries;
  for (int i = 0; i < 60; ++i) queries.emplace_back(draw.ray());
  for (int i = 0; i < 30; ++i) {
    Ray r = draw.ray();
    r.origin = {r.origin.x * 0x1p-1070, r.origin.y * 0x1p-1070, r.origin.z * 0x1p-1070};
    queries.emplace_back(r);
  }
  std::vector<BagTruth> expected;
  for (const Query& q : queries) expected.push_back(bag_truth(bag, q));
  for (const FloatEnvironment& environment : float_environments()) {
    std::vector<BagTruth> truths, of_bag;
    NearestHits hits;
    {
      const FloatScope scope(environment);
      const Scene scene(bag);
      for (const Query& q : queries) truths.push_back(scene.truth(q));
      for (const Query& q : queries) of_bag.push_back(bag_truth(bag, q));
      scene.nearest(queries, hits);
    }
    for (std::size_t i = 0; i < queries.size(); ++i) {
      ASSERT_TRUE(same(truths[i], expected[i])) << environment << " ray " << i;
      ASSERT_TRUE(same(of_bag[i], expected[i])) << environment << " ray " << i;
      ASSERT_EQ(hits.of(i).size(), expected[i].nearest()) << environment << " ray " << i;
    }
  }
}

TEST(Scene, NeedsLittleMemory) {
  LatticeBags draw(judges::seed(), 1000);
  std::vector<Triangle> bag;
  while (bag.size() < 100'000) bag.push_back(draw.triangle());
  EXPECT_LT(Scene(bag).bytes(), 200 * bag.size());
}

}  // namespace
}  // namespace plumbline
