#include "case/bag_families.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>

#include "case/float_bits.h"

namespace plumbline {
namespace {

constexpr std::array targets = {BagTarget::edge, BagTarget::vertex, BagTarget::face};
constexpr std::array origins = {BagOrigin::outside, BagOrigin::inside, BagOrigin::grazing};

template <class Visit>
void for_each_aim(Visit visit) {
  for (const BagTarget target : targets)
    for (const BagOrigin origin : origins)
      for (const auto& [precision, bits, ulps] :
           {std::tuple(Precision::binary32, 8, 0), std::tuple(Precision::binary32, 24, 2),
            std::tuple(Precision::binary64, 53, 1)})
        visit(BagAim{.target = target, .origin = origin, .precision = precision, .bits = bits, .ulps = ulps});
}

std::uint64_t checksum(BagFamily family) {
  std::uint64_t sum = 1469598103934665603u;
  const auto add = [&](const Vec3& v) {
    for (const double x : {v.x, v.y, v.z}) {
      sum = (sum ^ to_bits(x)) * 1099511628211u;
      sum ^= sum >> 29;
    }
  };
  for_each_aim([&](const BagAim& aim) {
    for (std::uint64_t i = 0; i < 4; ++i) {
      const AimedBag bag = draw(family, aim, 5, 1, i);
      for (const Triangle& t : bag.triangles) add(t.a), add(t.b), add(t.c);
      for (const Ray& r : bag.rays) add(r.origin), add(r.direction);
    }
  });
  return sum;
}

TEST(BagFamilies, AreTheSameBitsWithEveryCompiler) {
  const std::array<std::pair<std::string_view, std::uint64_t>, bag_family_names.size()> expected = {{
      {"pair", 0xeabbc08f5a1b117d},
      {"fan", 0xa87690bcd7e1a0ba},
      {"strip", 0xa932ffd8d0cc74eb},
      {"sphere", 0x8bb7210484f438ea},
      {"sheets", 0xdba1921cc247f38e},
      {"overlap", 0xdcb2238e83d36a2d},
      {"lattice", 0x95152f319c1639a9},
  }};
  for (std::size_t i = 0; i < bag_family_names.size(); ++i) {
    EXPECT_EQ(bag_family_names[i], expected[i].first);
    EXPECT_EQ(checksum(static_cast<BagFamily>(i)), expected[i].second) << bag_family_names[i];
  }
}

TEST(BagFamilies, ASeedAndAnIndexAreABagOfTheirOwn) {
  std::set<std::uint64_t> seen;
  for (const std::uint64_t seed : {1, 2})
    for (std::uint64_t index = 0; index < 100; ++index)
      seen.insert(to_bits(draw(BagFamily::pair, {.bits = 24}, 1, seed, index).triangles[0].a.x));
  EXPECT_EQ(seen.size(), 200u);
}

// Coordinates are multiples of 2^(2 - bits) below 2, of vertices of four times that; all numbers are of the
// precision.
TEST(BagFamilies, NumbersAreOfTheGrid) {
  const auto on_grid = [](const Vec3& v, int exponent) {
    return std::ranges::all_of(std::array{v.x, v.y, v.z}, [&](double x) {
      const double scaled = std::ldexp(x, -exponent);
      return scaled == std::floor(scaled) && std::abs(x) < 2;
    });
  };
  const auto narrow = [](const Vec3& v) { return is_binary32(v.x) && is_binary32(v.y) && is_binary32(v.z); };
  for (std::size_t f = 0; f < bag_family_names.size(); ++f)
    for_each_aim([&](const BagAim& aim) {
      const AimedBag bag = draw(static_cast<BagFamily>(f), aim, 10, 3, f);
      ASSERT_EQ(bag.rays.size(), 10u);
      for (const Triangle& t : bag.triangles)
        for (const Vec3& v : {t.a, t.b, t.c}) {
          EXPECT_TRUE(on_grid(v, 4 - aim.bits)) << bag_family_names[f];
          EXPECT_TRUE(aim.precision == Precision::binary64 || narrow(v));
        }
      for (const Ray& r : bag.rays) {
        EXPECT_TRUE(on_grid(r.origin, 2 - aim.bits)) << bag_family_names[f];
        EXPECT_NE(r.direction, Vec3{});
        EXPECT_TRUE(aim.precision == Precision::binary64 || (narrow(r.origin) && narrow(r.direction)));
      }
    });
}

TEST(BagFamilies, UlpsMoveTheDirectionAlone) {
  for (const auto& [precision, bits] : {std::pair(Precision::binary32, 24), std::pair(Precision::binary64, 53)}) {
    std::set<std::int64_t> steps;
    for (std::uint64_t index = 0; index < 20; ++index) {
      BagAim aim{.precision = precision, .bits = bits};
      const AimedBag exact = draw(BagFamily::fan, aim, 20, 1, index);
      aim.ulps = 2;
      const AimedBag moved = draw(BagFamily::fan, aim, 20, 1, index);
      EXPECT_EQ(exact.triangles, moved.triangles);
      for (std::size_t i = 0; i < exact.rays.size(); ++i) {
        EXPECT_EQ(exact.rays[i].origin, moved.rays[i].origin);
        const Vec3 &p = exact.rays[i].direction, &q = moved.rays[i].direction;
        for (const auto& [x, y] : {std::pair(p.x, q.x), std::pair(p.y, q.y), std::pair(p.z, q.z)})
          steps.insert(precision == Precision::binary64
                           ? ordinal(y) - ordinal(x)
                           : ordinal(static_cast<float>(y)) - ordinal(static_cast<float>(x)));
      }
    }
    EXPECT_EQ(steps, (std::set<std::int64_t>{-2, -1, 0, 1, 2}));
  }
}

TEST(BagFamilies, SpheresAreClosed) {
  for (const auto& [bits, triangles] : {std::pair(24, 1280u), std::pair(8, 80u)}) {
    const AimedBag bag = draw(BagFamily::sphere, {.bits = bits}, 0, 1, 0);
    EXPECT_TRUE(bag.closed);
    EXPECT_EQ(bag.triangles.size(), triangles);
    const auto key = [](const Vec3& v) { return std::array{v.x, v.y, v.z}; };
    std::map<std::array<std::array<double, 3>, 2>, int> sides;
    for (const Triangle& t : bag.triangles) {
      ++sides[{key(t.a), key(t.b)}];
      ++sides[{key(t.b), key(t.c)}];
      ++sides[{key(t.c), key(t.a)}];
      const Vec3 &a = t.a, &b = t.b, &c = t.c;
      EXPECT_GT(a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x), 0);
    }
    EXPECT_EQ(sides.size(), 3 * triangles);
    for (const auto& [edge, count] : sides) {
      EXPECT_EQ(count, 1);
      EXPECT_TRUE(sides.contains({edge[1], edge[0]}));
    }
  }
}

TEST(BagFamilies, SizesAreAsTheSummariesSay) {
  std::set<std::size_t> fans, sheets;
  for (std::uint64_t index = 0; index < 200; ++index) {
    EXPECT_EQ(draw(BagFamily::pair, {}, 0, 1, index).triangles.size(), 2u);
    EXPECT_FALSE(draw(BagFamily::strip, {}, 0, 1, index).closed);
    fans.insert(draw(BagFamily::fan, {}, 0, 1, index).triangles.size());
    sheets.insert(draw(BagFamily::sheets, {}, 0, 1, index).triangles.size());
  }
  EXPECT_EQ(fans, (std::set<std::size_t>{3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
  EXPECT_EQ(sheets, (std::set<std::size_t>{6, 8, 10, 12, 14, 16}));
}

TEST(BagFamilies, TheLatticeIsExhaustive) {
  const auto key = [](const Vec3& v) { return std::array{v.x, v.y, v.z}; };
  std::set<std::array<std::array<double, 3>, 4>> seen;
  std::set<std::array<double, 3>> points;
  for (std::uint64_t index = 0; index < lattice_bags; ++index) {
    const AimedBag bag = draw(BagFamily::lattice, {}, 0, 1, index);
    std::map<std::array<double, 3>, int> corners;
    for (const Triangle& t : bag.triangles)
      for (const Vec3& v : {t.a, t.b, t.c}) ++corners[key(v)];
    ASSERT_EQ(corners.size(), 4u);
    std::vector<std::array<double, 3>> shared, apex;
    for (const auto& [point, count] : corners) {
      (count == 2 ? shared : apex).push_back(point);
      points.insert(point);
    }
    ASSERT_EQ(shared.size(), 2u);
    seen.insert({shared[0], shared[1], apex[0], apex[1]});
  }
  EXPECT_EQ(points.size(), 27u);
  EXPECT_EQ(seen.size(), lattice_bags);
  EXPECT_EQ(draw(BagFamily::lattice, {}, 0, 1, 7).triangles.size(), 2u);
}

}  // namespace
}  // namespace plumbline
