#include "oracle/batch.h"

#include <algorithm>

#include "oracle/accumulator.h"
#include "oracle/invalid.h"
#include "oracle/integer.h"

namespace plumbline {
namespace {

LaneStages lane_stages(Isa isa) {
  switch (isa) {
#if defined(__x86_64__)
    case Isa::avx512: return lane_stages_avx512;
    case Isa::avx2: return lane_stages_avx2;
#else
    case Isa::avx512:
    case Isa::avx2:
#endif
    case Isa::portable: break;
  }
  return lane_stages_portable;
}

}  // namespace

bool available(Isa isa) {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (isa == Isa::avx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512bw");
  if (isa == Isa::avx2) return __builtin_cpu_supports("avx2");
#endif
  return isa == Isa::portable;
}

Isa best_isa() {
  static const Isa best = available(Isa::avx512) ? Isa::avx512 : available(Isa::avx2) ? Isa::avx2 : Isa::portable;
  return best;
}

// Not inlined: its stack and spills would slow the callers, whose filter mostly decides.
[[gnu::noinline]] Truth classify_scalar(const Triangle& triangle, const Ray& ray, const KnownSigns& known,
                                      StageCounts& counts) {
  if (const auto decided = classify_integer(triangle, ray, known)) {
    ++counts.integer;
    return *decided;
  }
  Truth truth;
  truth.invalid = why_invalid(triangle, ray);
  if (truth.invalid != Invalid::none) {
    ++counts.invalid;
    return truth;
  }
  if (const auto decided = classify_wide(triangle, ray, known)) {
    ++counts.wide;
    return *decided;
  }
  ++counts.accumulate;
  return classify_accumulate(triangle, ray);
}

void classify(const Batch& batch, Isa isa, StageCounts* counts) {
  const LaneStages stages = lane_stages(isa);
  StageCounts sum;
  std::uint32_t undecided[lane_block];
  for (Batch rest = batch; rest.size != 0;) {
    Batch block = rest;
    block.size = std::min<std::size_t>(lane_block, rest.size);
    const LaneCounts left = stages(block, undecided);
    sum.filter += block.size - left.past_filter;
    sum.residue += left.past_filter - left.past_residue;
    for (std::size_t k = 0; k < left.past_residue; ++k) {
      const std::size_t i = undecided[k], j = block.one_triangle ? 0 : i;
      const auto r = [&](std::size_t c) { return block.ray[c][i]; };
      const auto t = [&](std::size_t c) { return block.triangle[c][j]; };
      block.truths[i] = classify_scalar({{t(0), t(1), t(2)}, {t(3), t(4), t(5)}, {t(6), t(7), t(8)}},
                                            {{r(0), r(1), r(2)}, {r(3), r(4), r(5)}, r(6), r(7)}, std::bit_cast<KnownSigns>(block.truths[i]), sum);
    }
    rest.skip(block.size);
  }
  if (counts != nullptr) *counts = sum;
}

}  // namespace plumbline
