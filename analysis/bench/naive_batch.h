// What the oracle is measured against: Moller and Trumbore's test for a batch in columns, in lanes of the same
// instruction set and without contraction to FMA, like the oracle's own. It tells the hit bit only, with one division
// and no branch, and guarantees nothing.
#pragma once
#include <cstdint>

#include "oracle/batch.h"

namespace plumbline {

struct NaiveBatch {
  std::size_t lanes;
  /// Reads the columns of `batch`, whose size is a multiple of `lanes`. Bit i % lanes of hits[i / lanes] is case i.
  void (*run)(const Batch& batch, std::uint8_t* hits);
};

/// The instruction set is available.
NaiveBatch naive_batch(Isa isa);

void naive_batch_portable(const Batch& batch, std::uint8_t* hits);
#if defined(__x86_64__)
void naive_batch_avx2(const Batch& batch, std::uint8_t* hits);
void naive_batch_avx512(const Batch& batch, std::uint8_t* hits);
#endif

}  // namespace plumbline
