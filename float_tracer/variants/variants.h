// The textbook kernels once more, as a user's build may have them: the same source, other floating-point semantics.
//   NAME_fma        products and sums contracted to fused multiply-adds (-mfma -ffp-contract=fast)
//   NAME_fast_math  -ffast-math: reassociated, reciprocals for divisions, no NaN or infinity taken into account
//   NAME_ftz_daz    as written, run with subnormal results flushed to zero and subnormal operands taken as zero
// They promise what the kernel promises. x86-64 only; NAME_fma only where the processor has it.
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

inline constexpr const char *fma_suffix = "_fma", *fast_math_suffix = "_fast_math", *ftz_daz_suffix = "_ftz_daz";

std::vector<std::unique_ptr<Tracer>> kernel_variants();

/// The kernel of that index in for_each_kernel, compiled as the file's name says. Private to variants/.
std::unique_ptr<PreparedBag> prepare_with_fma(std::size_t kernel, const Bag& bag);
std::unique_ptr<PreparedBag> prepare_with_fast_math(std::size_t kernel, const Bag& bag);

}  // namespace plumbline
