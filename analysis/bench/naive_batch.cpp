#include "analysis/bench/naive_batch.h"

namespace plumbline {

NaiveBatch naive_batch(Isa isa) {
  switch (isa) {
#if defined(__x86_64__)
    case Isa::avx512:
      return {8, naive_batch_avx512};
    case Isa::avx2:
      return {4, naive_batch_avx2};
#else
    case Isa::avx512:
    case Isa::avx2:
#endif
    case Isa::portable:
      break;
  }
  return {2, naive_batch_portable};
}

}  // namespace plumbline
