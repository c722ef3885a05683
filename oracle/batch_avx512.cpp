#include "oracle/batch_kernel.h"

namespace plumbline {

LaneCounts lane_stages_avx512(const Batch& batch, std::uint32_t* undecided) {
  return BatchDriver<8>(batch, undecided).run();
}

}  // namespace plumbline
