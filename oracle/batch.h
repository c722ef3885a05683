// The stages of classify, for a batch in columns. Public calls are in classify.h; this is for them, for benchmarks and for
// tests that force a stage or an instruction set.
//
//   filter       binary64 with a proved error bound, W cases at a time                     batch_kernel.h
//   residue      integers modulo 2^64, W at a time: lattices, binary32-like data          batch_kernel.h
//   integer      exact 192-bit integers, one at a time: full doubles of few binades        integer.h
//   wide         exact 384-bit integers, one at a time: full doubles over 72 binades       integer.h
//   accumulate   any finite doubles: fixed-point sums                                     accumulator.h
//
// Each decides a case, with a proof, or leaves it to the next; the last leaves none. The case is looked at for validity
// only past the vector stages: those decide no case with a NaN or an infinite coordinate.
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "case/geometry.h"
#include "oracle/signs.h"
#include "oracle/truth.h"

namespace plumbline {

struct Batch {
  std::array<const double*, 9> triangle{};  ///< a.x a.y a.z b.x ... c.z; of one_triangle, each points at one value
  std::array<const double*, 8> ray{};       ///< origin, direction, t_min, t_max
  std::size_t size = 0;
  bool one_triangle = false;
  bool skip_filter = false;  ///< for tests: the residue stage sees every case
  Truth* truths = nullptr;

  /// Leaves out the first n cases.
  void skip(std::size_t n) {
    for (const double*& column : ray) column += n;
    if (!one_triangle)
      for (const double*& column : triangle) column += n;
    truths += n;
    size -= n;
  }
};

/// How many cases each stage decided.
struct StageCounts {
  std::size_t filter = 0, residue = 0, integer = 0, wide = 0, accumulate = 0, invalid = 0;
};

enum class Isa : unsigned char { portable, avx2, avx512 };
inline constexpr std::array<std::string_view, 3> isa_names = {"portable", "avx2", "avx512"};
constexpr std::string_view name(Isa isa) { return isa_names[static_cast<unsigned>(isa)]; }

/// Whether this processor and this build have it; `portable` is always there (two lanes: SSE2 on x86-64).
bool available(Isa isa);
/// The widest that is available.
Isa best_isa();

/// All of a batch. counts may be null.
void classify(const Batch& batch, Isa isa, StageCounts* counts);

/// One case by the stages past the vectors.
Truth classify_scalar(const Triangle& triangle, const Ray& ray, const KnownSigns& known, StageCounts& counts);

/// How many cases of a run each vector stage left undecided.
struct LaneCounts {
  std::size_t past_filter = 0, past_residue = 0;
};

/// At most this many cases per run.
inline constexpr std::uint32_t lane_block = 1024;

/// The vector stages: decide what they can of a batch of at most lane_block cases, and list the indices of the others in
/// `undecided`, which has room for as many. In the place of the truth of an undecided case they leave its KnownSigns.
using LaneStages = LaneCounts (*)(const Batch& batch, std::uint32_t* undecided);

LaneCounts lane_stages_portable(const Batch& batch, std::uint32_t* undecided);
#if defined(__x86_64__)
LaneCounts lane_stages_avx2(const Batch& batch, std::uint32_t* undecided);
LaneCounts lane_stages_avx512(const Batch& batch, std::uint32_t* undecided);
#endif

// The vector stages write a Truth, or KnownSigns, as one 64-bit word.
static_assert(sizeof(KnownSigns) == 8 && offsetof(KnownSigns, det) == 0 && offsetof(KnownSigns, ab) == 1 &&
              offsetof(KnownSigns, bc) == 2 && offsetof(KnownSigns, ca) == 3 && offsetof(KnownSigns, past_min) == 4 &&
              offsetof(KnownSigns, past_max) == 5);
static_assert(sizeof(Truth) == 8 && offsetof(Truth, hit_class) == 0 && offsetof(Truth, feature) == 1 &&
              offsetof(Truth, det_sign) == 2 && offsetof(Truth, versus_t_min) == 3 && offsetof(Truth, versus_t_max) == 4 &&
              offsetof(Truth, invalid) == 5 && std::endian::native == std::endian::little);

}  // namespace plumbline
