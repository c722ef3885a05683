// The last stage over the whole range of exponents: the longest sums, long carries, and cancellation down to the least
// subnormals.
#include "oracle/accumulator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "oracle/explain.h"
#include "tests/judges/mpq_judge.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"
#include "tests/oracle/grid_shots.h"

namespace plumbline {
namespace {

constexpr double least = 0x1p-1074, normal = 0x1p-1022, largest = 0x1.fffffffffffffp+1023;

void expect_right(const Shot& shot) {
  if (shot.ray.direction == Vec3{}) return;
  ASSERT_EQ(classify_accumulate(shot.triangle, shot.ray), judges::mpq_truth(shot.triangle, shot.ray))
      << explain(shot.triangle, shot.ray);
}

template <class Draw>
Shot draw_shot(Draw x) {
  const auto v = [&] {
    const double a = x(), b = x(), c = x();
    return Vec3{a, b, c};
  };
  Shot shot{{v(), v(), v()}, {v(), v()}};
  shot.ray.t_min = x();
  shot.ray.t_max = x();
  return shot;
}

TEST(Accumulator, ExtremeNumbersInEveryPlace) {
  constexpr std::array extremes = {0.0,         least,          2 * least,
                                   normal,      normal - least, 1.0,
                                   1 + 0x1p-52, 1 - 0x1p-53,    0x1.fffffffffffffp+0,
                                   largest,     0x1p+1023,      0x1.ffffffffffffep+1023};
  Random random(judges::seed());
  std::printf("seed %llu\n", static_cast<unsigned long long>(judges::seed()));
  for (int i = 0; i < 8000; ++i) {
    // From a few of them at a time, so that terms cancel.
    std::array<double, 3> few{};
    for (double& x : few) x = extremes[random() % extremes.size()];
    ASSERT_NO_FATAL_FAILURE(expect_right(draw_shot([&] {
      const double x = random() % 4 == 0 ? extremes[random() % extremes.size()] : few[random() % 3];
      return random() % 2 == 0 ? x : -x;
    })));
  }
}

// T's terms reach up to 2^3072, tau * det's down to 2^-4504, and T cancels: a ray from a vertex, t - tau = -tau.
TEST(Accumulator, TheLongestSum) {
  const double m = largest, s = least;
  for (const double tau : {s, -s, 2 * s, normal, 1.0, -m})
    for (const Vec3 direction : {Vec3{s, s, s}, Vec3{m, m, m}, Vec3{m, s, s}, Vec3{-s, m, s}}) {
      const Triangle triangle{{m, s, s}, {s, m, s}, {s, s, m}};
      for (const Vec3 origin : {triangle.a, triangle.b, triangle.c}) {
        Shot shot{triangle, {origin, direction}};
        shot.ray.t_min = tau;
        shot.ray.t_max = -tau;
        ASSERT_NO_FATAL_FAILURE(expect_right(shot));
      }
    }
}

// Windows of ones end to end: a unit at the bottom carries through all of them.
TEST(Accumulator, LongCarries) {
  Random random(judges::seed() + 1);
  for (int i = 0; i < 8000; ++i) {
    const int stride = random() % 2 == 0 ? 53 : static_cast<int>(uniform(random, 50, 66));
    ASSERT_NO_FATAL_FAILURE(expect_right(draw_shot([&] {
      const double ones = random() % 3 == 0 ? 0x1p+0 : 0x1.fffffffffffffp+52;
      const double x = std::ldexp(ones, stride * static_cast<int>(uniform(random, -6, 6)));
      return random() % 3 == 0 ? 0.0 : random() % 2 == 0 ? x : -x;
    })));
  }
}

// An exact meeting with an edge, with a remainder at any distance below: t = 1 and every sign hangs on one small
// number.
TEST(Accumulator, OneSmallNumberDecides) {
  Random random(judges::seed() + 2);
  for (int i = 0; i < 8000; ++i) {
    Shot shot =
        draw_on_grids(random, static_cast<int>(uniform(random, 1, 53)), static_cast<int>(uniform(random, 1, 53)));
    shot = scaled(shot, static_cast<int>(uniform(random, -400, 900)), static_cast<int>(uniform(random, -400, 900)));
    std::vector<double*> all;
    for (Vec3* v : {&shot.ray.origin, &shot.ray.direction, &shot.triangle.a, &shot.triangle.b, &shot.triangle.c})
      for (double* x : {&v->x, &v->y, &v->z})
        if (*x == 0) all.push_back(x);
    const double small = std::ldexp(random() % 2 == 0 ? 1.0 : -1.0, static_cast<int>(uniform(random, -1074, 500)));
    if (!all.empty()) *all[random() % all.size()] = small;
    shot.ray.t_max =
        std::ldexp(static_cast<double>(uniform(random, 1, 3)), static_cast<int>(uniform(random, -1074, 1000)));
    ASSERT_NO_FATAL_FAILURE(expect_right(shot));
  }
}

// Leading terms that nearly cancel: the shortcut over one dominant term must not be taken too early.
TEST(Accumulator, TermsOfNearlyOneSize) {
  Random random(judges::seed() + 3);
  for (int i = 0; i < 20000; ++i) {
    const int spread = static_cast<int>(uniform(random, 0, 5));
    ASSERT_NO_FATAL_FAILURE(expect_right(draw_shot([&] {
      const double ones = random() % 2 == 0 ? 0x1p+0 : 0x1.fffffffffffffp+0;
      const double x = std::ldexp(ones, static_cast<int>(uniform(random, 0, spread)));
      return random() % 8 == 0 ? 0.0 : random() % 2 == 0 ? x : -x;
    })));
  }
}

// The terms of det next to the largest are 2^5 smaller by their estimates, and yet outweigh it.
TEST(Accumulator, ManySmallTermsOutweighTheLeader) {
  constexpr double ones = 0x1.fffffffffffffp+0;
  const Shot shot{{{-ones / 2, 0, -0x1p-4}, {2 * ones, -8 * ones, -0x1p+4}, {ones / 2, 0x1p+1, ones / 16}},
                  {{-0x1p-3, -0x1p-2, 0}, {-0x1p+2, -ones / 2, ones}}};
  ASSERT_NO_FATAL_FAILURE(expect_right(shot));
}

}  // namespace
}  // namespace plumbline
