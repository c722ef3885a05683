// Around every limit of every stage: the last width, exponent or bound inside is decided by the stage, rightly; the
// first outside is passed on.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "case/float_bits.h"
#include "oracle/explain.h"
#include "tests/judges/mpq_judge.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"
#include "tests/oracle/grid_shots.h"
#include "tests/oracle/stages.h"

namespace plumbline {
namespace {

// The limits as the stages' comments give them.
constexpr int residue_point_bits = 30, residue_direction_bits = 31;
constexpr int integer_bits = 61, wide_bits = 125;
constexpr int residue_exponents = 300, integer_exponents = 900;  // the first that is outside, the last that is inside

const std::vector<Stage>& residue_stages() {
  static const std::vector<Stage> list = [] {
    std::vector<Stage> stages;
    for (const Isa isa : all_isas()) stages.push_back({Stage::residue, isa});
    return stages;
  }();
  return list;
}

// A decided answer is right; `must` says whether there has to be one, where that is known.
void expect_answer(const Stage& stage, const Shot& shot, const Truth& expected, std::optional<bool> must) {
  const auto answer = ask(stage, shot);
  if (must) {
    ASSERT_EQ(answer.has_value(), *must) << stage.name() << '\n' << explain(shot.triangle, shot.ray);
  }
  if (answer) {
    ASSERT_EQ(*answer, expected) << stage.name() << '\n' << explain(shot.triangle, shot.ray);
  }
}

void expect_at_width(const Shot& shot) {
  const Truth expected = judges::mpq_truth(shot.triangle, shot.ray);
  const Width points = point_width(shot), direction = direction_width(shot);
  const bool inside =
      points.bits() > 0 && points.bits() <= residue_point_bits && direction.bits() <= residue_direction_bits;
  for (const Stage& stage : residue_stages()) ASSERT_NO_FATAL_FAILURE(expect_answer(stage, shot, expected, inside));
  for (const Isa isa : all_isas())
    ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::filter, isa}, shot, expected, std::nullopt));
  const bool integers = points.bits() > 0 && points.bits() <= integer_bits && direction.bits() <= integer_bits;
  ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::integer}, shot, expected, integers));
  ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::wide}, shot, expected, true));
  ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::accumulate}, shot, expected, true));
  ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::single_call}, shot, expected, true));
}

TEST(StageLimits, GridsOfEveryWidth) {
  Random random(judges::seed());
  std::printf("seed %llu\n", static_cast<unsigned long long>(judges::seed()));
  for (int point_bits = 1; point_bits <= 62; ++point_bits)
    for (int direction_bits = 1; direction_bits <= 62; ++direction_bits)
      for (int i = 0; i < 4; ++i)
        ASSERT_NO_FATAL_FAILURE(expect_at_width(draw_on_grids(random, point_bits, direction_bits)))
            << point_bits << ' ' << direction_bits;
}

TEST(StageLimits, GridsAroundTheResidueStagesLimits) {
  Random random(judges::seed() + 1);
  for (int point_bits = 28; point_bits <= 33; ++point_bits)
    for (int direction_bits = 28; direction_bits <= 34; ++direction_bits)
      for (int i = 0; i < 300; ++i)
        ASSERT_NO_FATAL_FAILURE(expect_at_width(draw_on_grids(random, point_bits, direction_bits)))
            << point_bits << ' ' << direction_bits;
}

TEST(StageLimits, GridsAroundTheIntegerStagesLimits) {
  Random random(judges::seed() + 2);
  for (const int point_bits : {52, 53, 54, 58, 59, 60, 61, 62})
    for (const int direction_bits : {2, 20, 40, 53, 54, 60, 61, 62})
      for (int i = 0; i < 100; ++i)
        ASSERT_NO_FATAL_FAILURE(expect_at_width(draw_on_grids(random, point_bits, direction_bits)))
            << point_bits << ' ' << direction_bits;
}

// Widths that differ by one bit at an end: the same case, with one coordinate made odd.
TEST(StageLimits, ThePreciseLastBit) {
  const auto shot_of = [](int point_bits, int direction_bits) {
    const double top = std::ldexp(1.0, point_bits - 1), far = std::ldexp(1.0, direction_bits - 1);
    return Shot{{{0, 0, 1}, {top, 0, 1}, {0, top, 1}}, {{0, 0, 0}, {1, 1, far}}};
  };
  for (const Stage& stage : residue_stages()) {
    EXPECT_TRUE(ask(stage, shot_of(30, 31)));
    EXPECT_FALSE(ask(stage, shot_of(31, 31)));
    EXPECT_FALSE(ask(stage, shot_of(30, 32)));
  }
  const auto wide = [](int point_bits, int direction_bits) {
    const double top = std::ldexp(1.0, point_bits - 1), far = std::ldexp(1.0, direction_bits - 1);
    return Shot{{{0, 0, 1}, {top, 0, 1}, {0, top, 1}}, {{top / 4, top / 4, 0}, {1, 1, far}}};
  };
  EXPECT_TRUE(ask({Stage::integer}, wide(61, 61)));
  EXPECT_FALSE(ask({Stage::integer}, wide(62, 61)));
  EXPECT_FALSE(ask({Stage::integer}, wide(61, 62)));
  EXPECT_TRUE(ask({Stage::wide}, wide(125, 125)));
  EXPECT_FALSE(ask({Stage::wide}, wide(126, 125)));
  EXPECT_FALSE(ask({Stage::wide}, wide(125, 126)));
}

TEST(StageLimits, Exponents) {
  Random random(judges::seed() + 3);
  const std::array exponents = {-1022, -901, -900, -899, -301, -300, -299, -298, 0,
                                298,   299,  300,  301,  899,  900,  901,  1023};
  for (const int points : exponents)
    for (const int direction : exponents)
      for (int i = 0; i < 8; ++i) {
        const auto bits = [&](int most) { return static_cast<int>(uniform(random, 1, most)); };
        Shot shot = draw_on_grids(random, bits(30), bits(31));
        if (point_width(shot).bits() == 0) continue;
        shot = scaled(shot, points - point_width(shot).exponent(), direction - direction_width(shot).exponent());
        const bool inside = std::abs(points) < residue_exponents && std::abs(direction) < residue_exponents;
        const bool integers = std::abs(points) <= integer_exponents && std::abs(direction) <= integer_exponents;
        const Truth expected = judges::mpq_truth(shot.triangle, shot.ray);
        for (const Stage& stage : residue_stages())
          ASSERT_NO_FATAL_FAILURE(expect_answer(stage, shot, expected, inside));
        ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::integer}, shot, expected, integers));
        ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::wide}, shot, expected, true));
        ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::accumulate}, shot, expected, true));
      }
}

// A right-angled triangle with legs e in the plane z, seen from its middle: norms d, max(e / 4, z), e.
Shot with_norms(double d, double z, double e) {
  return {{{0, 0, z}, {e, 0, z}, {0, e, z}}, {{e / 4, e / 4, 0}, {0, 0, d}}};
}

TEST(StageLimits, TheFiltersRange) {
  constexpr double least = 0x1p-300, most = 0x1p+300;
  const double inside[] = {0x1.0000000000001p-300, 0x1.fffffffffffffp+299}, outside[] = {least, most};
  for (const Isa isa : all_isas()) {
    const Stage filter{Stage::filter, isa};
    for (const double d : inside) EXPECT_TRUE(ask(filter, with_norms(d, 1, 1))) << d;
    for (const double d : outside) EXPECT_FALSE(ask(filter, with_norms(d, 1, 1))) << d;
    EXPECT_TRUE(ask(filter, with_norms(1, 0x1.fffffffffffffp+299, 0x1p+280)));
    EXPECT_FALSE(ask(filter, with_norms(1, 0x1p+300, 0x1p+280)));
    EXPECT_TRUE(ask(filter, with_norms(1, 0x1.0000000000001p-300, 0x1p-299)));
    EXPECT_FALSE(ask(filter, with_norms(1, 0x1p-300, 0x1p-299)));
    EXPECT_TRUE(ask(filter, with_norms(1, 0x1p+280, 0x1.fffffffffffffp+299)));
    EXPECT_FALSE(ask(filter, with_norms(1, 0x1p+280, 0x1p+300)));
    EXPECT_TRUE(ask(filter, with_norms(1, 0x1p-290, 0x1.0000000000001p-300)));
    EXPECT_FALSE(ask(filter, with_norms(1, 0x1p-290, 0x1p-300)));
    // One edge long, the other short: the longer counts.
    Shot shot = with_norms(1, 1, 1);
    shot.triangle.c.y = 0x1p-20;
    shot.ray.origin = {0.25, 0x1p-22, 0};
    EXPECT_TRUE(ask(filter, shot));
    std::swap(shot.triangle.b, shot.triangle.c);
    EXPECT_TRUE(ask(filter, shot));
  }
}

// Bounds of t for the residue stage are m g / (64 g'), |m| <= 2^13: exact meetings with a bound, and one unit beside
// it.
TEST(StageLimits, BoundsOfTheResidueStage) {
  constexpr double unit = 0x1p-6, reach = 0x1p+13;
  const double ms[] = {0,    1,    2,     63,  64,   65,     127,     4095,    4096,      8190,    8191,    8192,
                       8193, 8194, 16384, 0.5, 64.5, 8191.5, 0x1p+51, 0x1p+52, 0x1.8p+52, 0x1p+53, 0x1p+60, 0x1p+1000};
  // g = g' = 1: a point coordinate has bit 29, the direction bit 30.
  for (const double magnitude : ms)
    for (const double m : {magnitude, -magnitude})
      for (const double k : {1.0, 3.0, 32767.0, 65535.0})
        for (const double off : {-1.0, 0.0, 1.0})
          for (const bool upward : {false, true}) {
            const double z = upward ? m * k : -m * k;  // the plane, exactly at t = m / 64, where it fits
            const bool exact = std::fabs(z) < 0x1p+29 && z == std::floor(z);
            const double height = exact ? z + off : off * 5;
            const double far = 0x1p+29 + 12345;
            const Shot base{{{-far, -far, height}, {far, -far, height}, {0, far, height}}, {{0, 0, 0}, {0, 0, 0}}};
            Shot shot = base;
            shot.ray.direction = {0x1p+30, 1, upward ? 64 * k : -64 * k};
            // The origin such that the ray meets the plane inside: the hit is at D t.
            const double t = height / shot.ray.direction.z;
            shot.ray.origin.x = -std::round(t * 0x1p+30 / 0x1p+6) * 0x1p+6;
            if (std::fabs(shot.ray.origin.x) >= 0x1p+30) shot.ray.origin.x = 0;
            for (const bool at_min : {false, true}) {
              shot.ray.t_min = at_min ? m * unit : -std::numeric_limits<double>::infinity();
              shot.ray.t_max = at_min ? std::numeric_limits<double>::infinity() : m * unit;
              const Truth expected = judges::mpq_truth(shot.triangle, shot.ray);
              const bool taken = std::fabs(m) <= reach && m == std::floor(m);
              const bool needed = expected.hit_class <= HitClass::vertex;
              for (const Stage& stage : residue_stages())
                ASSERT_NO_FATAL_FAILURE(expect_answer(stage, shot, expected, taken || !needed)) << m;
              ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::integer}, shot, expected, true)) << m;
              ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::wide}, shot, expected, true)) << m;
              ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::accumulate}, shot, expected, true)) << m;
            }
          }
}

// Zeros of both signs, infinities of both signs, subnormals and the largest numbers, at either end.
TEST(StageLimits, SpecialBounds) {
  constexpr double inf = std::numeric_limits<double>::infinity(), largest = std::numeric_limits<double>::max();
  constexpr double bounds[] = {0.0, -0.0, 0x1p-1074, -0x1p-1074, 0.5, -0.5, 1, largest, -largest, inf, -inf};
  for (const double dz : {1.0, -1.0, 0.75})
    for (const double z : {1.0, -1.0, 0.0, 0.1})
      for (const double low : bounds)
        for (const double high : bounds) {
          const Shot shot{{{-1, -1, z}, {1, -1, z}, {0, 1, z}}, {{0.25, -0.25, 0}, {0, 0, dz}, low, high}};
          const Truth expected = judges::mpq_truth(shot.triangle, shot.ray);
          for (const Stage& stage : all_stages()) {
            const auto answer = ask(stage, shot);
            if (answer) {
              ASSERT_EQ(*answer, expected) << stage.name() << '\n' << explain(shot.triangle, shot.ray);
            }
            const auto easy = [&](double tau) { return std::isinf(tau) || (std::fabs(tau) < largest && z != 0 && z != dz); };
            if (stage.kind == Stage::filter && easy(low) && easy(high) && std::fabs(z) == 1) {
              ASSERT_TRUE(answer.has_value()) << low << ' ' << high;
            }
            const auto gridded = [](double tau) { return tau == 0 || std::isinf(tau) || std::fabs(tau) == 0.5 || tau == 1; };
            if (stage.kind == Stage::residue && z != 0.1 && gridded(low) && gridded(high)) {
              ASSERT_TRUE(answer.has_value()) << low << ' ' << high;
            }
          }
        }
}

// The same limit with extreme corners, at every scale of points and direction.
TEST(StageLimits, BoundsOfTheResidueStageOnEveryGrid) {
  Random random(judges::seed() + 4);
  int decided = 0, passed_on = 0;
  for (int i = 0; i < 30000; ++i) {
    Shot shot =
        draw_on_grids(random, static_cast<int>(uniform(random, 1, 30)), static_cast<int>(uniform(random, 1, 31)));
    const Width points = point_width(shot), direction = direction_width(shot);
    if (points.bits() == 0) continue;
    const int shift = static_cast<int>(uniform(random, -200, 200));
    shot = scaled(shot, 0, shift);
    // g / (64 g')
    const double unit = std::ldexp(1.0, (points.exponent() - 29) - (direction.exponent() + shift - 30) - 6);
    const auto bound = [&] {
      static constexpr double near[] = {8191, 8192, 8193, 1, 64, 4096, 8191.5, 0x1p+14};
      const double m = random() % 2 == 0 ? near[random() % 8] : static_cast<double>(uniform(random, 0, 9000));
      return random() % 2 == 0 ? m : -m;
    };
    const double low = bound(), high = bound();
    shot.ray.t_min = low * unit;
    shot.ray.t_max = high * unit;
    const Truth expected = judges::mpq_truth(shot.triangle, shot.ray);
    const auto taken = [](double m) { return std::fabs(m) <= 0x1p+13 && m == std::floor(m); };
    const bool inside = expected.hit_class > HitClass::vertex || (taken(low) && taken(high));
    (inside ? decided : passed_on) += 1;
    for (const Stage& stage : residue_stages()) ASSERT_NO_FATAL_FAILURE(expect_answer(stage, shot, expected, inside));
    ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::integer}, shot, expected, true));
    ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::wide}, shot, expected, true));
    ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::accumulate}, shot, expected, true));
  }
  std::printf("%d decided, %d passed on\n", decided, passed_on);
  EXPECT_GT(decided, 1000);
  EXPECT_GT(passed_on, 1000);
}

// Each axis of points and direction times a power of two: every product of a determinant has one factor of each axis,
// so that its sign stays, while the coordinates spread.
Shot stretched(Random& random, Shot shot, int most) {
  const auto power = [&] { return std::ldexp(1.0, static_cast<int>(uniform(random, 0, most))); };
  const Vec3 by = {power(), power(), power()};
  for (Vec3* v : {&shot.ray.origin, &shot.triangle.a, &shot.triangle.b, &shot.triangle.c, &shot.ray.direction})
    *v = {v->x * by.x, v->y * by.y, v->z * by.z};
  return shot;
}

TEST(StageLimits, GridsOfTheWideStage) {
  Random random(judges::seed() + 6);
  std::size_t inside = 0, at_limit = 0, outside = 0;
  for (int i = 0; i < 40000; ++i) {
    const auto bits = [&] { return static_cast<int>(uniform(random, 40, 62)); };
    const auto stretch = static_cast<int>(uniform(random, 62, 95));
    const Shot shot = stretched(random, draw_on_grids(random, bits(), bits()), stretch);
    const Truth expected = judges::mpq_truth(shot.triangle, shot.ray);
    const int widest = std::max(point_width(shot).bits(), direction_width(shot).bits());
    (widest > wide_bits ? outside : inside) += 1;
    at_limit += widest == wide_bits ? 1 : 0;
    ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::wide}, shot, expected, widest <= wide_bits));
    ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::accumulate}, shot, expected, true));
    ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::single_call}, shot, expected, true));
  }
  std::printf("%zu inside, %zu of them at the limit, %zu outside\n", inside, at_limit, outside);
  EXPECT_GT(inside, 10000u);
  EXPECT_GT(at_limit, 100u);
  EXPECT_GT(outside, 1000u);
}

// Bounds of t of every exponent and width, exact meetings among them.
void check_bounds(const Stage& stage, Random& random, int stretch) {
  int met = 0, exactly = 0;
  for (int i = 0; i < 30000; ++i) {
    const auto bits = [&] { return static_cast<int>(uniform(random, 1, 61)); };
    Shot shot = stretched(random, draw_on_grids(random, bits(), bits()), stretch);
    if (point_width(shot).bits() == 0) continue;
    const judges::Determinants x = judges::mpq_determinants(shot.triangle, shot.ray);
    const double near = x.det == 0 ? 1 : mpq_class(x.T / x.det).get_d();
    const auto bound = [&] {
      switch (random() % 4) {
        case 0: return step_ulps(near, static_cast<std::int64_t>(random() % 3) - 1);
        case 1: return near;
        case 2:
          return std::ldexp(static_cast<double>(uniform(random, -15, 15)),
                            static_cast<int>(uniform(random, -1074, 1000)));
        default:
          return std::ldexp(static_cast<double>(uniform(random, -15, 15)), static_cast<int>(uniform(random, -60, 10)));
      }
    };
    shot.ray.t_min = bound();
    shot.ray.t_max = bound();
    const Truth expected = judges::mpq_truth(shot.triangle, shot.ray);
    met += expected.hit_class <= HitClass::vertex ? 1 : 0;
    exactly += expected.hit_class <= HitClass::vertex && expected.versus_t_min == 0 ? 1 : 0;
    ASSERT_NO_FATAL_FAILURE(expect_answer(stage, shot, expected, true));
    ASSERT_NO_FATAL_FAILURE(expect_answer({Stage::accumulate}, shot, expected, true));
  }
  std::printf("%s: %d of 30000 met the triangle, %d of them at t_min\n", stage.name().c_str(), met, exactly);
  EXPECT_GT(met, 1000);
  EXPECT_GT(exactly, 100);
}

// The integer stage compares products of 245 bits, the wide one of 434.
TEST(StageLimits, BoundsOfTheIntegerStage) {
  Random random(judges::seed() + 5);
  check_bounds({Stage::integer}, random, 0);
  check_bounds({Stage::wide}, random, 63);
}

}  // namespace
}  // namespace plumbline
