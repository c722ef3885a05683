#include "analysis/bench/naive_batch_kernel.h"

namespace plumbline {

void naive_batch_avx512(const Batch& batch, std::uint8_t* hits) { NaiveKernel<8>::run(batch, hits); }

}  // namespace plumbline
