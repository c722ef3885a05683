// No stage decides a case that has no geometry, wherever the NaN or infinity stands and whatever else the case holds;
// the single call and the batch say why.
#include "oracle/invalid.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "case/float_bits.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"
#include "tests/oracle/grid_shots.h"
#include "tests/oracle/stages.h"

namespace plumbline {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

std::array<double*, 17> numbers(Shot& s) {
  auto& [t, r] = s;
  return {&t.a.x,         &t.a.y,         &t.a.z,         &t.b.x,      &t.b.y,      &t.b.z,
          &t.c.x,         &t.c.y,         &t.c.z,         &r.origin.x, &r.origin.y, &r.origin.z,
          &r.direction.x, &r.direction.y, &r.direction.z, &r.t_min,    &r.t_max};
}

void expect_invalid(const Shot& shot) {
  const Truth expected{.invalid = why_invalid(shot.triangle, shot.ray)};
  ASSERT_NE(expected.invalid, Invalid::none);
  for (const Stage& stage : all_stages()) {
    if (stage.kind == Stage::wide || stage.kind == Stage::accumulate) continue;  // take valid cases alone
    const auto answer = ask(stage, shot);
    if (stage.kind == Stage::single_call) {
      ASSERT_TRUE(answer.has_value());
    }
    if (answer) {
      ASSERT_EQ(*answer, expected) << stage.name();
    }
  }
  for (const Isa isa : all_isas()) {
    const std::vector<Shot> copies(9, shot);
    std::vector<Truth> truths(copies.size());
    classify(Columns(copies).batch(truths.data()), isa, nullptr);
    for (const Truth& truth : truths) ASSERT_EQ(truth, expected) << name(isa);
  }
}

std::vector<Shot> ordinary() {
  std::vector<Shot> shots;
  Random random(judges::seed());
  for (std::uint64_t i = 0; i < 20; ++i)
    for (const Family family : {Family::random, Family::lattice_points, Family::exact_edge23, Family::exact_edge51,
                                Family::coplanar, Family::degenerate, Family::wide})
      shots.push_back(draw(family, judges::seed() + 7, i));
  for (int i = 0; i < 60; ++i) shots.push_back(draw_on_grids(random, 20, 20));
  return shots;
}

TEST(InvalidCases, OneBadNumberAnywhere) {
  const double quiet = std::numeric_limits<double>::quiet_NaN(), payload = from_bits<double>(0xfff8000000000001u),
               signalling = from_bits<double>(0x7ff0000000000001u);
  for (const Shot& shot : ordinary())
    for (std::size_t k = 0; k < 17; ++k)
      for (const double bad : {quiet, -quiet, payload, signalling, inf, -inf}) {
        if (k >= 15 && !is_nan(bad)) continue;  // bounds of t may be infinite
        Shot changed = shot;
        *numbers(changed)[k] = bad;
        ASSERT_NO_FATAL_FAILURE(expect_invalid(changed)) << k << ' ' << bad;
      }
}

TEST(InvalidCases, SeveralBadNumbers) {
  Random random(judges::seed());
  for (const Shot& shot : ordinary())
    for (int i = 0; i < 20; ++i) {
      Shot changed = shot;
      for (int n = 0; n < 3; ++n)
        *numbers(changed)[random() % 15] =
            random() % 2 == 0 ? (random() % 2 == 0 ? inf : -inf) : std::numeric_limits<double>::quiet_NaN();
      ASSERT_NO_FATAL_FAILURE(expect_invalid(changed));
    }
}

TEST(InvalidCases, AZeroDirection) {
  for (Shot shot : ordinary())
    for (const Vec3& zero : {Vec3{}, Vec3{-0.0, 0, -0.0}}) {
      shot.ray.direction = zero;
      ASSERT_NO_FATAL_FAILURE(expect_invalid(shot));
      shot.ray.t_min = std::numeric_limits<double>::quiet_NaN();
      ASSERT_NO_FATAL_FAILURE(expect_invalid(shot));
    }
  // The residue stage has the answer at once.
  for (const Isa isa : all_isas()) {
    const auto answer = ask({Stage::residue, isa}, {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 0, 0}, {0, -0.0, 0}}});
    EXPECT_EQ(answer, (Truth{.invalid = Invalid::zero_direction}));
  }
}

}  // namespace
}  // namespace plumbline
