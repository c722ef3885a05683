// Compiled with -ffast-math. Nothing but kernels belongs here: see fma.cpp.
#define PLUMBLINE_KERNELS with_fast_math
#include "float_tracer/variants/prepare.h"
#include "float_tracer/variants/variants.h"

namespace plumbline {

std::unique_ptr<PreparedBag> prepare_with_fast_math(std::size_t kernel, const Bag& bag) {
  return prepare_kernel(kernel, bag);
}

}  // namespace plumbline
