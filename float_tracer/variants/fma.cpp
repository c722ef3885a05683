// Compiled with -mfma -ffp-contract=fast. Nothing but kernels belongs here: what else the linker might share with the
// rest of the program, it must not take from this file.
#define PLUMBLINE_KERNELS with_fma
#include "float_tracer/variants/prepare.h"
#include "float_tracer/variants/variants.h"

namespace plumbline {

std::unique_ptr<PreparedBag> prepare_with_fma(std::size_t kernel, const Bag& bag) { return prepare_kernel(kernel, bag); }

}  // namespace plumbline
