#include "oracle/batch_kernel.h"

namespace plumbline {

LaneCounts lane_stages_portable(const Batch& batch, std::uint32_t* undecided) {
  return BatchDriver<2>(batch, undecided).run();
}

}  // namespace plumbline
