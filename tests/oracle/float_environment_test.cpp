// Every stage in every rounding mode, with FTZ and DAZ: the truths of the default environment, on all families and on
// subnormal data.
#include "tests/oracle/float_environment.h"

#include <gtest/gtest.h>

#include "oracle/explain.h"
#include "tests/judges/mpq_judge.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"
#include "tests/oracle/grid_shots.h"
#include "tests/oracle/stages.h"

namespace plumbline {
namespace {

bool valid(const Shot& s) { return !(s.ray.direction == Vec3{}); }

void expect_same_everywhere(std::vector<Shot> shots) {
  std::erase_if(shots, [](const Shot& s) { return !valid(s); });
  std::vector<Truth> expected;
  for (const auto& [triangle, ray] : shots) expected.push_back(judges::mpq_truth(triangle, ray));
  for (const Stage& stage : all_stages()) {
    const auto usual = ask(stage, shots);
    for (const FloatEnvironment& environment : float_environments()) {
      std::vector<std::optional<Truth>> answers;
      {
        const FloatScope scope(environment);
        answers = ask(stage, shots);
      }
      for (std::size_t i = 0; i < shots.size(); ++i) {
        // The filter may decide more in one mode than in another; which it decides must be right.
        if (stage.kind != Stage::filter) {
          ASSERT_EQ(answers[i].has_value(), usual[i].has_value()) << stage.name() << ' ' << environment;
        }
        if (answers[i]) {
          ASSERT_EQ(*answers[i], expected[i]) << stage.name() << ' ' << environment << '\n'
                                              << explain(shots[i].triangle, shots[i].ray);
        }
      }
    }
  }
}

class EveryEnvironment : public testing::TestWithParam<std::size_t> {};

TEST_P(EveryEnvironment, GivesTheSameTruths) {
  std::vector<Shot> shots;
  for (std::uint64_t i = 0; i < 400; ++i) shots.push_back(draw(static_cast<Family>(GetParam()), judges::seed() + 4, i));
  expect_same_everywhere(std::move(shots));
}

// All coordinates among the subnormals, or the points alone, or the direction alone; and the bounds of t.
TEST(FloatEnvironments, GiveTheSameTruthsOfSubnormals) {
  Random random(judges::seed());
  std::vector<Shot> shots;
  for (int i = 0; i < 3000; ++i) {
    Shot shot =
        draw_on_grids(random, static_cast<int>(uniform(random, 2, 24)), static_cast<int>(uniform(random, 2, 24)));
    const bool points = random() % 3 != 0, direction = !points || random() % 2 == 0;
    shot = scaled(shot, points ? -1074 : 0, direction ? -1074 : 0);
    if (random() % 2 == 0) shot.ray.t_min = random() % 2 == 0 ? 0x1p-1074 : -0x1.8p-1030;
    if (random() % 2 == 0) shot.ray.t_max = random() % 2 == 0 ? 0x1p-1060 : 0x1p-1;
    shots.push_back(shot);
  }
  expect_same_everywhere(std::move(shots));
}

// One subnormal among ordinary numbers is not a zero: it moves an exact meeting to one side.
TEST(FloatEnvironments, GiveTheSameTruthsOfOneSubnormal) {
  Random random(judges::seed() + 1);
  std::vector<Shot> shots;
  for (int i = 0; i < 4000; ++i) {
    Shot shot = draw_on_grids(random, 2, 3);
    std::vector<double*> zeros;
    for (Vec3* v : {&shot.ray.origin, &shot.ray.direction, &shot.triangle.a, &shot.triangle.b, &shot.triangle.c})
      for (double* x : {&v->x, &v->y, &v->z})
        if (*x == 0) zeros.push_back(x);
    if (!zeros.empty()) *zeros[random() % zeros.size()] = random() % 2 == 0 ? 0x1p-1074 : -0x1.8p-1024;
    if (random() % 4 == 0) shot.ray.t_min = 0x1p-1074;
    if (random() % 4 == 0) shot.ray.t_max = -0x1p-1030;
    shots.push_back(shot);
  }
  expect_same_everywhere(std::move(shots));
}

// Products that underflow or come near it, and those that come near overflow: each scale that the filter and the
// residue stage take, and the next ones that they must pass on.
TEST(FloatEnvironments, GiveTheSameTruthsAtTheEndsOfTheRange) {
  Random random(judges::seed() + 2);
  std::vector<Shot> shots;
  for (const int points : {-360, -330, -302, -300, -299, -298, 0, 250, 270, 298, 299, 300, 301})
    for (const int direction : {-360, -330, -302, -300, -299, -298, 0, 250, 270, 298, 299, 300, 301})
      for (int i = 0; i < 20; ++i) {
        const int bits = static_cast<int>(uniform(random, 1, 33));
        Shot shot = scaled(draw_on_grids(random, bits, bits + 1), points - bits + 1, direction - bits + 1);
        if (random() % 2 == 0) shot.ray.t_min = std::ldexp(1.0, points - direction);
        if (random() % 2 == 0) shot.ray.t_max = std::ldexp(1.0, static_cast<int>(uniform(random, -1074, 1023)));
        shots.push_back(shot);
      }
  expect_same_everywhere(std::move(shots));
}

INSTANTIATE_TEST_SUITE_P(All, EveryEnvironment, testing::Range<std::size_t>(0, family_names.size()),
                         [](const auto& each) { return std::string(family_names[each.param]); });

}  // namespace
}  // namespace plumbline
