// What must hold of truths among themselves, whatever they are: laws of the determinants, on all families. Only exact
// changes are made to a case; where a change would round, that case is left out.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "oracle/classify.h"
#include "oracle/explain.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"
#include "tests/oracle/grid_shots.h"

namespace plumbline {
namespace {

Truth truth_of(const Shot& s) { return classify(s.triangle, s.ray); }

signed char negated(signed char sign) { return static_cast<signed char>(-sign); }

constexpr std::array vertices = {Feature::a, Feature::b, Feature::c};

// The feature by its vertices: which[i] is the place of old vertex i in the new triangle.
Feature renamed(Feature feature, const std::array<std::size_t, 3>& which) {
  constexpr std::array edges = {Feature::ab, Feature::bc, Feature::ca};
  for (std::size_t i = 0; i < 3; ++i) {
    if (feature == vertices[i]) return vertices[which[i]];
    if (feature == edges[i]) {
      const std::size_t from = which[i], to = which[(i + 1) % 3];
      return (from + 1) % 3 == to ? edges[from] : edges[to];
    }
  }
  return feature;
}

bool same(double x, double scaled, int by) { return std::ldexp(scaled, -by) == x; }

// By a power of two along each axis; nothing where a bit is lost.
std::optional<Shot> scaled_axes(const Shot& s, const std::array<int, 3>& by) {
  Shot r = s;
  for (Vec3* v : {&r.triangle.a, &r.triangle.b, &r.triangle.c, &r.ray.origin, &r.ray.direction}) {
    const std::array<double*, 3> x = {&v->x, &v->y, &v->z};
    for (std::size_t k = 0; k < 3; ++k) {
      const double before = *x[k];
      *x[k] = std::ldexp(before, by[k]);
      if (!same(before, *x[k], by[k])) return std::nullopt;
    }
  }
  return r;
}

class Laws : public testing::TestWithParam<std::size_t> {
 protected:
  static Family family() { return static_cast<Family>(GetParam()); }
  template <class Check>
  void for_all(Check check) {
    for (std::uint64_t i = 0; i < 1000 && !HasFailure(); ++i) {
      const Shot shot = draw(family(), judges::seed() + 5, i);
      const Truth truth = truth_of(shot);
      if (truth.invalid != Invalid::none) continue;
      SCOPED_TRACE(testing::Message() << "seed " << judges::seed() + 5 << " index " << i);
      check(shot, truth);
    }
  }
};

TEST_P(Laws, VerticesMayBePermuted) {
  for_all([](const Shot& s, const Truth& truth) {
    const std::array<Vec3, 3> corner = {s.triangle.a, s.triangle.b, s.triangle.c};
    // p[i] is the old vertex at place i.
    for (const auto& p : {std::array<std::size_t, 3>{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}) {
      const bool odd = (p[0] + 1) % 3 != p[1];
      std::array<std::size_t, 3> which{};
      for (std::size_t i = 0; i < 3; ++i) which[p[i]] = i;
      Truth expected = truth;
      expected.feature = renamed(truth.feature, which);
      if (odd) expected.det_sign = negated(truth.det_sign);
      EXPECT_EQ(truth_of({{corner[p[0]], corner[p[1]], corner[p[2]]}, s.ray}), expected) << explain(s.triangle, s.ray);
    }
  });
}

TEST_P(Laws, AxesMayBePermutedAndReflected) {
  for_all([](const Shot& s, const Truth& truth) {
    const auto changed = [&](auto change) {
      return Shot{{change(s.triangle.a), change(s.triangle.b), change(s.triangle.c)},
                  {change(s.ray.origin), change(s.ray.direction), s.ray.t_min, s.ray.t_max}};
    };
    EXPECT_EQ(truth_of(changed([](const Vec3& v) { return Vec3{v.y, v.z, v.x}; })), truth);
    EXPECT_EQ(truth_of(changed([](const Vec3& v) { return Vec3{v.z, v.x, v.y}; })), truth);
    EXPECT_EQ(truth_of(changed([](const Vec3& v) { return Vec3{-v.x, -v.y, v.z}; })), truth);
    Truth mirrored = truth;
    mirrored.det_sign = negated(truth.det_sign);
    EXPECT_EQ(truth_of(changed([](const Vec3& v) { return Vec3{v.y, v.x, v.z}; })), mirrored);
    EXPECT_EQ(truth_of(changed([](const Vec3& v) { return Vec3{v.x, v.y, -v.z}; })), mirrored);
  });
}

TEST_P(Laws, AxesMayBeScaledByPowersOfTwo) {
  Random random(judges::seed());
  int scaled_cases = 0;
  for_all([&](const Shot& s, const Truth& truth) {
    for (const int reach : {3, 60, 500}) {
      std::array<int, 3> by{};
      for (int& k : by) k = static_cast<int>(uniform(random, -reach, reach));
      const auto other = scaled_axes(s, by);
      if (!other) continue;
      ++scaled_cases;
      EXPECT_EQ(truth_of(*other), truth) << explain(s.triangle, s.ray);
    }
  });
  if (family() != Family::full_range) {
    EXPECT_GT(scaled_cases, 100);
  }
}

// D -> k D takes t to t / k.
TEST_P(Laws, TheDirectionMayBeScaled) {
  int scaled_cases = 0;
  for_all([&](const Shot& s, const Truth& truth) {
    for (const double k : {0.5, 2.0, 0x1p-40, 0x1p+40, 3.0, 5.0}) {
      Ray ray = s.ray;
      const auto times_k = [k](double x) {
        return std::fma(x, k, -(x * k)) == 0 && std::isfinite(x * k) ? x * k : NAN;
      };
      ray.direction = {times_k(ray.direction.x), times_k(ray.direction.y), times_k(ray.direction.z)};
      ray.t_min /= k;
      ray.t_max /= k;
      const auto exact = [k](double divided, double before) {
        return std::isinf(before) || (divided * k == before && std::fma(divided, k, -before) == 0);
      };
      // Subnormal results may hide a remainder.
      const auto safe = [](double x) { return x == 0 || std::fabs(x) > 0x1p-900; };
      const Vec3& d = ray.direction;
      if (std::isnan(d.x + d.y + d.z) || !safe(d.x) || !safe(d.y) || !safe(d.z) || !exact(ray.t_min, s.ray.t_min) ||
          !exact(ray.t_max, s.ray.t_max))
        continue;
      ++scaled_cases;
      EXPECT_EQ(classify(s.triangle, ray), truth) << k << '\n' << explain(s.triangle, s.ray);
    }
  });
  if (family() != Family::full_range) {
    EXPECT_GT(scaled_cases, 100);
  }
}

// D -> -D takes t to -t.
TEST_P(Laws, TheRayMayBeReversed) {
  for_all([](const Shot& s, const Truth& truth) {
    const Vec3& d = s.ray.direction;
    Truth expected = truth;
    expected.det_sign = negated(truth.det_sign);
    expected.versus_t_min = negated(truth.versus_t_max);
    expected.versus_t_max = negated(truth.versus_t_min);
    EXPECT_EQ(classify(s.triangle, {s.ray.origin, {-d.x, -d.y, -d.z}, -s.ray.t_max, -s.ray.t_min}), expected)
        << explain(s.triangle, s.ray);
  });
}

// Triangle b, a, x on the other side of ab: its determinant of that edge is the negative, zero where that is zero. So a
// line that meets the edge between its ends meets it seen from both, and one that passes through both interiors meets a
// front and a back.
TEST_P(Laws, ASharedEdgeIsTheSameFromBothSides) {
  Random random(judges::seed());
  int met = 0;
  for_all([&](const Shot& s, const Truth&) {
    const std::array<Vec3, 3> corner = {s.triangle.a, s.triangle.b, s.triangle.c};
    const Shot other = draw(family(), judges::seed() + 6, random());
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &from = corner[k], &to = corner[(k + 1) % 3];
      const Shot here{{from, to, corner[(k + 2) % 3]}, s.ray};
      const Truth mine = truth_of(here);
      for (const Vec3& x : {other.triangle.a, other.triangle.b, other.triangle.c}) {
        const Truth theirs = classify({to, from, x}, s.ray);
        if (mine.det_sign == 0 || theirs.det_sign == 0) continue;
        const auto seen = [](const Truth& t) { return t.hit_class == HitClass::edge && t.feature == Feature::ab; };
        EXPECT_EQ(seen(mine), seen(theirs)) << explain(s.triangle, s.ray);
        EXPECT_EQ(mine.feature == Feature::a, theirs.feature == Feature::b) << explain(s.triangle, s.ray);
        EXPECT_EQ(mine.feature == Feature::b, theirs.feature == Feature::a) << explain(s.triangle, s.ray);
        if (mine.hit_class == HitClass::interior && theirs.hit_class == HitClass::interior) {
          EXPECT_EQ(mine.det_sign, -theirs.det_sign) << explain(s.triangle, s.ray);
        }
        met += seen(mine) ? 1 : 0;
      }
    }
  });
  if (family() == Family::exact_edge23 || family() == Family::exact_edge51) {
    EXPECT_GT(met, 500);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Laws, testing::Range<std::size_t>(0, family_names.size()),
                         [](const auto& each) { return std::string(family_names[each.param]); });

}  // namespace
}  // namespace plumbline
