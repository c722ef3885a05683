// A hostile tracer that changes how floats are computed: it is told of, and nobody else's are changed.
#include <gtest/gtest.h>

#include <cfenv>
#include <cstdint>
#ifdef __x86_64__
#include <xmmintrin.h>
#endif

#include "float_tracer/float_environment.h"
#include "tests/float_tracer/hostile.h"

namespace plumbline {
namespace {

void round_upward(Answer&) { std::fesetround(FE_UPWARD); }
#ifdef __x86_64__
void flush_to_zero(Answer&) { _mm_setcsr(_mm_getcsr() | 0x8040); }
void shorten_x87(Answer&) {
  std::uint16_t word;
  asm volatile("fnstcw %0" : "=m"(word));
  word = static_cast<std::uint16_t>(word & ~0x300);
  asm volatile("fldcw %0" : : "m"(word));
}
constexpr Deed disturbances[] = {round_upward, flush_to_zero, shorten_x87};
#else
constexpr Deed disturbances[] = {round_upward};
#endif

TEST(Isolated, ChangedControlsAreToldAndPutBack) {
  for (const Deed deed : disturbances) {
    const Hostile in_process(deed);
    const auto wrapped = hostile(deed);
    for (const Tracer* tracer :
         {static_cast<const Tracer*>(&in_process), static_cast<const Tracer*>(wrapped.get())}) {
      const auto bag = tracer->prepare(one);
      const FloatEnvironment before;
      expect_faults(*bag, rays_with({}), {});
      EXPECT_FALSE(bag->disturbed());
      expect_faults(*bag, rays_with({17}), {});
      EXPECT_TRUE(bag->disturbed());
      EXPECT_FALSE(before.restore());
    }
    const auto fresh = wrapped->prepare(one);  // by the same child
    expect_faults(*fresh, rays_with({}), {});
    EXPECT_FALSE(fresh->disturbed());
  }
}

TEST(Isolated, ControlsChangedByABagAreTold) {
  Bag two = one;
  two.triangles.push_back(one.triangles[0]);
  const auto tracer = hostile(round_upward);
  const auto bag = tracer->prepare(two);
  expect_faults(*bag, rays_with({}), {});
  EXPECT_TRUE(bag->disturbed());
}

TEST(Isolated, WorksUnderTheCallersControls) {
  const auto tracer = hostile([](Answer& answer) { answer.t = std::fegetround(); });
  const auto bag = tracer->prepare(one);
  for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    const auto rays = rays_with({0}, 1);
    Answer answer;
    std::fesetround(mode);
    bag->trace(rays, {&answer, 1});
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(answer.t, mode);
  }
  EXPECT_FALSE(bag->disturbed());
}

}  // namespace
}  // namespace plumbline
