#include "oracle/batch_kernel.h"

namespace plumbline {

LaneCounts lane_stages_avx2(const Batch& batch, std::uint32_t* undecided) {
  return BatchDriver<4>(batch, undecided).run();
}

}  // namespace plumbline
