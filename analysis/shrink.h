// Makes a finding plain: the simplest case that a tracer gets wrong in the same way.
//
// Simpler is, in this order: fewer significant bits (each counts four), leading bits nearer to 1 (each power of two counts
// one) and fewer minus signs, added up over all numbers; then fewer ones among the bits. A range [0, inf] counts nothing.
// Findings lie on a knife's edge: rounding one coordinate moves the ray off it. So numbers are simplified hard and then
// one coordinate is solved for exactly (oracle/boundary.h), which puts the ray back.
//
// Every step is examined by tracer and oracle. The same case and tracer give the same result; nothing is left to the
// clock.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "analysis/signature.h"
#include "case/case_bytes.h"

namespace plumbline {

/// What a simpler case has to keep, beside the tracer, and kind, element and rejection of the signature.
enum class Keep : unsigned char {
  simple,   ///< nothing else
  nominal,  ///< the condition: nominal, or which condition numbers are small
  worst,    ///< the whole signature, and at least half of the severity
};
inline constexpr std::array<std::string_view, 3> keep_names = {"simple", "nominal", "worst"};
constexpr std::string_view name(Keep k) { return keep_names[static_cast<unsigned>(k)]; }

struct Shrunk {
  FuzzInput input;
  Examination before, after;
  unsigned bits_before = 0, bits_after = 0;  ///< significant bits of all numbers
  std::uint64_t tries = 0;                   ///< cases examined
};

/// No value where the tracer gets the input right. The numbers stay in the domain of nominal numbers, if they are in it.
std::optional<Shrunk> shrink(const FuzzInput& input, const Tracer& tracer, Keep keep);

/// Significant bits of all numbers: 1 for a power of two, 0 for 0. A default range counts nothing.
unsigned significant_bits(const FuzzInput& input);

}  // namespace plumbline
