#include "analysis/bench/naive_batch_kernel.h"

namespace plumbline {

void naive_batch_portable(const Batch& batch, std::uint8_t* hits) { NaiveKernel<2>::run(batch, hits); }

}  // namespace plumbline
