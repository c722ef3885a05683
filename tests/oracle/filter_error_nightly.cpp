// A long search for wrong signs. Its finds, one row each, are what filter_worst_cases_test.cpp keeps.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/judges/seed.h"
#include "tests/oracle/filter_search.h"

namespace plumbline {
namespace {

void print_row(Measured m, const char* mode, const Worst& worst) {
  const auto& [t, r] = worst.shot;
  std::printf("    // %g\n    {Measured::%s, %s, {{", worst.ratio, measured_names[static_cast<std::size_t>(m)].data(),
              mode);
  const auto print = [](const Vec3& v, const char* after) { std::printf("{%a, %a, %a}%s", v.x, v.y, v.z, after); };
  print(t.a, ", "), print(t.b, ", "), print(t.c, "}, {"), print(r.origin, ", "), print(r.direction, "");
  if (m == Measured::V || m == Measured::V_alone) std::printf(", %a", r.t_min);
  std::printf("}}},\n");
}

TEST(FilterErrorNightly, WrongSignsStayBelowHalfTheBound) {
  Random random(judges::seed() + 1);
  for (std::size_t m = 0; m < measured_names.size(); ++m)
    for (const auto& [mode, mode_name] :
         {std::pair{FE_TONEAREST, "FE_TONEAREST"}, std::pair{FE_UPWARD, "FE_UPWARD"},
          std::pair{FE_DOWNWARD, "FE_DOWNWARD"}, std::pair{FE_TOWARDZERO, "FE_TOWARDZERO"}}) {
      const auto measured = static_cast<Measured>(m);
      const Worst worst = climb(measured, Objective::wrong_side, {.rounding = mode}, random, 5000000);
      print_row(measured, mode_name, worst);
      std::fflush(stdout);
      if (measured != Measured::V_alone) {
        EXPECT_LT(worst.ratio, 0.5);
      }
    }
}

}  // namespace
}  // namespace plumbline
