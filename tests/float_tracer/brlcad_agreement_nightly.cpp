// Every night other rays at a real BRL-CAD.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/float_tracer/brlcad_agreement.h"
#include "tests/judges/seed.h"

namespace plumbline {
namespace {

// Of a thousand rays, so many may be beyond the model.
void report(const BrlcadAgreement& agreement, std::uint64_t beyond = 1) {
  std::printf(
      "%llu rays, %llu of them hits, %llu partitions, %llu beyond the model, %llu differences; PLUMBLINE_SEED=%llu\n",
      static_cast<unsigned long long>(agreement.rays()), static_cast<unsigned long long>(agreement.hits()),
      static_cast<unsigned long long>(agreement.partitions()), static_cast<unsigned long long>(agreement.beyond()),
      static_cast<unsigned long long>(agreement.differences()),
      static_cast<unsigned long long>(judges::nightly_seed()));
  EXPECT_GT(agreement.hits(), agreement.rays() / 20);
  EXPECT_LT(agreement.beyond(), beyond * agreement.rays() / 1000);
  EXPECT_EQ(agreement.differences(), 0u);
}

TEST(BrlcadLibrt, EqualsClassicOnTheHardFamilies) {
  BrlcadAgreement agreement;
  agreement.compare_families(judges::nightly_seed(), 20000);
  report(agreement);
}

TEST(BrlcadLibrt, EqualsClassicOnLattices) {
  BrlcadAgreement agreement;
  for (const double offset : {0.0, 0.25, -100.125})
    for (const double standoff : {5.0, 0.25, 2.5, 10000.0}) agreement.compare_lattice(offset, standoff);
  report(agreement);
}

TEST(BrlcadLibrt, EqualsClassicOnAimedRays) {
  BrlcadAgreement agreement;
  agreement.compare_aimed(judges::nightly_seed(), 50000);
  report(agreement);
}

// Beyond are bags of more than 32 faces: those of which four are left at most, and rays that hang.
TEST(BrlcadLibrt, EqualsClassicOnMeshes) {
  BrlcadAgreement agreement;
  agreement.compare_meshes(judges::nightly_seed(), 40000);
  report(agreement, 40);
}

}  // namespace
}  // namespace plumbline
