// The truth of a hundred thousand bags against CGAL's exact constructions, and inside and outside of a hundred thousand
// points against another exact method.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "oracle/bag/bag_truth.h"
#include "oracle/bag/segments.h"
#include "tests/judges/epeck_bag.h"
#include "tests/judges/rational_judge.h"
#include "tests/judges/seed.h"
#include "tests/oracle/bag/bags.h"

namespace plumbline::judges {
namespace {

struct Seen {
  std::uint64_t bags = 0, hits = 0, ties = 0, stretches = 0;
};

void expect_epecks(const std::vector<Triangle>& bag, const Ray& ray, Seen& seen) {
  const BagTruth truth = bag_truth(bag, ray);
  const EpeckBag other = epeck_bag(bag, ray);
  ASSERT_EQ(truth.invalid, Invalid::none);
  ASSERT_EQ(truth.hits.size(), other.hits.size());
  for (std::size_t i = 0; i < truth.hits.size(); ++i) {
    ASSERT_EQ(truth.hits[i].triangle, other.hits[i].triangle) << i;
    ASSERT_EQ(truth.hits[i].rank, other.hits[i].rank) << i;
    // And t, correctly rounded, against a third judge.
    ASSERT_TRUE(is_rounded(rational_meeting(bag[truth.hits[i].triangle], ray).t, truth.hits[i].t)) << i;
  }
  ASSERT_EQ(truth.stretches.size(), other.stretches.size());
  for (std::size_t i = 0; i < truth.stretches.size(); ++i)
    ASSERT_EQ(truth.stretches[i].triangle, other.stretches[i]) << i;
  ++seen.bags;
  seen.hits += truth.hits.size();
  seen.ties += truth.nearest() > 1;
  seen.stretches += truth.stretches.size();
}

void report(const char* what, const Seen& s) {
  std::printf("%s, seed %llu: %llu bags, %llu hits, %llu with a tie in front, %llu stretches\n", what,
              static_cast<unsigned long long>(seed()), static_cast<unsigned long long>(s.bags),
              static_cast<unsigned long long>(s.hits), static_cast<unsigned long long>(s.ties),
              static_cast<unsigned long long>(s.stretches));
}

TEST(BagTruth, IsEpecksOnLattices) {
  LatticeBags small(seed(), 1), larger(seed(), 2);
  Seen seen;
  for (int i = 0; i < 60'000; ++i) {
    LatticeBags& draw = i % 2 ? small : larger;
    const auto bag = draw.bag(6);
    Ray ray = draw.ray();
    if (i % 4 == 0) ray.t_min = -std::numeric_limits<double>::infinity();
    if (i % 9 == 0) ray.t_max = 1;
    ASSERT_NO_FATAL_FAILURE(expect_epecks(bag, ray, seen)) << "bag " << i;
  }
  report("lattices", seen);
  EXPECT_GT(seen.ties, 500u);
  EXPECT_GT(seen.stretches, 2000u);
}

// Full doubles: random triangles, stacked sheets a few ulps apart, pairs and fans with rays at what they share.
TEST(BagTruth, IsEpecksOnDoubles) {
  std::mt19937_64 random(seed() + 1);
  const auto number = [&] { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; };
  const auto point = [&] { return Vec3{number(), number(), number()}; };
  const auto towards = [](const Vec3& from, const Vec3& to) {
    return Ray{.origin = from, .direction = {to.x - from.x, to.y - from.y, to.z - from.z}};
  };
  Seen seen;
  for (int i = 0; i < 40'000; ++i) {
    std::vector<Triangle> bag;
    Ray ray;
    switch (i % 3) {
      case 0:
        for (int k = 0; k < 5; ++k) bag.push_back({point(), point(), point()});
        ray = towards(point(), bag[0].b);
        break;
      case 1: {  // each sheet an ulp or none behind the one before
        Triangle sheet = {point(), point(), point()};
        for (int k = 0; k < 4; ++k) {
          bag.push_back(sheet);
          for (Vec3* v : {&sheet.a, &sheet.b, &sheet.c})
            if (random() % 2) v->z = std::nextafter(v->z, 2);
        }
        const Vec3 middle = {(sheet.a.x + sheet.b.x + sheet.c.x) / 3, (sheet.a.y + sheet.b.y + sheet.c.y) / 3,
                             (sheet.a.z + sheet.b.z + sheet.c.z) / 3};
        ray = towards(point(), middle);
        break;
      }
      default: {  // a fan, the ray at its hub
        const Vec3 hub = point();
        std::vector<Vec3> rim;
        for (int k = 0; k < 5; ++k) rim.push_back(point());
        for (std::size_t k = 0; k < 5; ++k) bag.push_back({hub, rim[k], rim[(k + 1) % 5]});
        ray = towards(point(), hub);
      }
    }
    ASSERT_NO_FATAL_FAILURE(expect_epecks(bag, ray, seen)) << "bag " << i;
  }
  report("doubles", seen);
  EXPECT_GT(seen.hits, 40'000u);
}

// How often a bag winds around a point, along a generic direction: one that meets no edge and runs in no plane, drawn
// until there is one, every sign by Boost's rationals. No value on the surface.
std::optional<int> winding_by_rationals(const std::vector<Triangle>& bag, const Vec3& point, std::mt19937_64& random) {
  const auto big = [&] { return static_cast<double>(static_cast<std::int64_t>(random() % 2'000'001) - 1'000'000); };
  for (;;) {
    const Ray ray{.origin = point, .direction = {big(), big(), big()}};
    if (ray.direction == Vec3{}) continue;
    int winding = 0;
    bool generic = true;
    for (const Triangle& t : bag) {
      const RationalMeeting met = rational_meeting(t, ray);
      const HitClass c = met.truth.hit_class;
      if (c == HitClass::degenerate) {
        if (met.touches && rational_meeting(t, {.origin = point, .direction = {1, 0, 0}, .t_max = 0}).touches)
          return std::nullopt;
        continue;
      }
      if (c <= HitClass::vertex && met.truth.versus_t_min == 0) return std::nullopt;
      if (c == HitClass::exterior || (c <= HitClass::vertex && met.truth.versus_t_min < 0)) continue;
      if (c != HitClass::interior) {
        generic = false;
        break;
      }
      winding += met.truth.det_sign;
    }
    if (generic) return winding;
  }
}

TEST(WindingNumber, IsThatAlongAnotherRay) {
  LatticeBags draw(seed() + 2, 2);
  std::uint64_t inside_count = 0, surface = 0, twice = 0, points = 0;
  for (int i = 0; i < 5000; ++i) {
    std::vector<Triangle> bag = draw.tetrahedron();
    if (i % 2)  // a second one, which may overlap the first or share its faces
      for (const Triangle& t : draw.tetrahedron()) bag.push_back(t);
    if (i % 5 == 0)
      for (const Triangle& t : box({-1, -1, -1}, {1, 1, 1})) bag.push_back(t);
    for (int k = 0; k < 20; ++k, ++points) {
      Vec3 p = draw.point();
      if (k % 2) p = {p.x / 2, p.y / 2, p.z / 2};
      const auto expected = winding_by_rationals(bag, p, draw.random());
      ASSERT_EQ(winding_number(bag, p), expected) << "bag " << i << " point " << k;
      inside_count += expected.value_or(0) != 0;
      twice += expected.value_or(0) > 1;
      surface += !expected;
      // Inside and outside by parity, from the pieces of the ray along another axis.
      if (!expected) continue;
      const auto pieces = inside(bag, Ray{.origin = p, .direction = {0, 0, 1}, .t_min = 0, .t_max = 0x1p-20});
      ASSERT_TRUE(pieces);
      ASSERT_EQ(pieces->size(), static_cast<std::size_t>(*expected & 1)) << "bag " << i << " point " << k;
    }
  }
  std::printf("seed %llu: %llu points, %llu inside, %llu more than once, %llu on the surface\n",
              static_cast<unsigned long long>(seed()), static_cast<unsigned long long>(points),
              static_cast<unsigned long long>(inside_count), static_cast<unsigned long long>(twice),
              static_cast<unsigned long long>(surface));
  EXPECT_EQ(points, 100'000u);
  EXPECT_GT(inside_count, 2000u);
  EXPECT_GT(twice, 100u);
  EXPECT_GT(surface, 5000u);
}

}  // namespace
}  // namespace plumbline::judges
