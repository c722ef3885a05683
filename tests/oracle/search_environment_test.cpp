// What a search asks, in every rounding mode, with FTZ and DAZ: the same truths, signs and roots, and margins
// that are still near to the exact ones.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "case/float_bits.h"
#include "oracle/boundary.h"
#include "oracle/exact_margins.h"
#include "oracle/explain.h"
#include "tests/judges/print.h"
#include "tests/judges/seed.h"
#include "tests/oracle/float_environment.h"
#include "tests/oracle/grid_shots.h"

namespace plumbline {
namespace {

std::vector<Shot> all_shots() {
  std::vector<Shot> shots;
  for (std::size_t f = 0; f < family_names.size(); ++f)
    for (std::uint64_t i = 0; i < 60; ++i)
      shots.push_back(draw(static_cast<Family>(f), judges::seed() + 10, i));
  Random random(judges::seed() + 10);
  for (int i = 0; i < 400; ++i)  // points, direction or both among the subnormals
    shots.push_back(scaled(draw_on_grids(random, 8, 8), i % 3 == 0 ? 0 : -1074, i % 3 == 1 ? 0 : -1074));
  return shots;
}

struct Answers {
  std::vector<std::optional<Margins>> margins;
  std::vector<std::optional<double>> roots;
};

Answers ask(const std::vector<Shot>& shots) {
  Answers answers;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const auto& [triangle, ray] = shots[i];
    answers.margins.push_back(margins(triangle, ray, Precision::binary64));
    for (const Precision precision : {Precision::binary32, Precision::binary64})
      answers.roots.push_back(
          boundary(triangle, ray, static_cast<Decision>(i % 6), static_cast<int>(i / 6 % 15), precision));
  }
  return answers;
}

bool same_bits(const std::optional<double>& x, const std::optional<double>& y) {
  return x.has_value() == y.has_value() && (!x || to_bits(*x) == to_bits(*y));
}

bool near(double x, double exact) {
  if (std::isnan(exact) || !std::isfinite(exact)) return to_bits(x) == to_bits(exact);
  return std::abs(x - exact) <= std::max(0x1p-40 * std::abs(exact), 0x1p-1074);
}

TEST(SearchEnvironments, GiveTheSameTruthsSignsAndRoots) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(judges::seed()));
  const std::vector<Shot> shots = all_shots();
  const Answers usual = ask(shots);
  std::vector<std::optional<Margins>> exact;
  for (const auto& [triangle, ray] : shots) exact.push_back(exact_margins(triangle, ray, Precision::binary64));
  for (const FloatEnvironment& environment : float_environments()) {
    Answers answers;
    {
      const FloatScope scope(environment);
      answers = ask(shots);
    }
    for (std::size_t i = 0; i < shots.size(); ++i) {
      SCOPED_TRACE(testing::Message() << environment << '\n' << explain(shots[i].triangle, shots[i].ray));
      ASSERT_TRUE(same_bits(answers.roots[2 * i], usual.roots[2 * i]));
      ASSERT_TRUE(same_bits(answers.roots[2 * i + 1], usual.roots[2 * i + 1]));
      const auto &m = answers.margins[i], &e = exact[i];
      ASSERT_EQ(m.has_value(), e.has_value());
      if (!m) continue;
      ASSERT_EQ(m->truth, e->truth);
      ASSERT_EQ(m->hit, e->hit);
      ASSERT_EQ(m->ab, e->ab);
      ASSERT_EQ(m->bc, e->bc);
      ASSERT_EQ(m->ca, e->ca);
      for (const auto member :
           {&Margins::severity, &Margins::severity_ulps, &Margins::sine, &Margins::altitude, &Margins::size,
            &Margins::t, &Margins::u, &Margins::v, &Margins::w, &Margins::t_scale, &Margins::u_scale,
            &Margins::v_scale, &Margins::w_scale})
        ASSERT_TRUE(near((*m).*member, (*e).*member)) << (*m).*member << ' ' << (*e).*member;
    }
  }
}

}  // namespace
}  // namespace plumbline
