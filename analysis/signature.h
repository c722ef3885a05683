// What makes two findings of one tracer the same: how it is wrong, at which part of the triangle or ray, by which of its
// own tests, and under which condition. How badly it is wrong (severity) is an attribute of a finding, no part of this.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "analysis/examine.h"
#include "case/case.h"
#include "float_tracer/rejection.h"
#include "oracle/measure.h"

namespace plumbline {

enum class FindingKind : unsigned char {
  false_miss,
  false_hit,
  displaced,   ///< a hit that is one, with t, u or v of a point farther off than 2^-10 of the triangle's longest edge
  not_finite,  ///< a hit that is one, with a t, u or v that is NaN or infinite
  death,       ///< a tracer in a child died of it
  leak,           ///< of several triangles (oracle/bag/judge.h), as all below: a point that must be hit, and none is
  wrong_nearest,  ///< a hit, but not the one that has to be first
};
inline constexpr std::array<std::string_view, 7> finding_kind_names = {
    "false-miss", "false-hit", "displaced", "not-finite", "death", "leak", "wrong-nearest"};
constexpr std::string_view name(FindingKind k) { return finding_kind_names[static_cast<unsigned>(k)]; }

/// What the answer has wrong. Of a false hit: the edge or, beyond two edges, the vertex that the line passes by; the
/// end of the range that it would have to be beyond; or the plane that it runs beside. Of a false miss: the edge,
/// vertex or end of the range that is nearest. Of what is displaced: the plane, if t is off by more than u and v.
enum class Element : unsigned char { none, ab, bc, ca, a, b, c, plane, t_min, t_max };
inline constexpr std::array<std::string_view, 10> element_names = {"none", "ab", "bc", "ca",    "a",
                                                                   "b",    "c",  "plane", "t_min", "t_max"};
constexpr std::string_view name(Element e) { return element_names[static_cast<unsigned>(e)]; }

/// Of what the case is ill-conditioned: the least of the three condition numbers, if it is below 2^-10; far as well where
/// the ray's range ends farther away than the largest coordinate (Examination::far_range). Before that:
/// range, if a number of the tracer's over- or underflowed, so that findings of rounding and of range never mix.
enum class Conditioning : unsigned char { nominal, grazing, sliver, far, range };
inline constexpr std::array<std::string_view, 5> conditioning_names = {"nominal", "grazing", "sliver", "far", "range"};
constexpr std::string_view name(Conditioning c) { return conditioning_names[static_cast<unsigned>(c)]; }

struct Signature {
  FindingKind kind = FindingKind::false_miss;
  Element element = Element::none;
  Rejection rejection = Rejection::none;  ///< of a false miss: the first wrong sign, where the tracer tells
  bool boundary = false;  ///< wrong by its own rule on an exact edge, vertex or end of the range: severity 0
  Conditioning conditioning = Conditioning::nominal;
  unsigned char bucket = 0;  ///< the least condition number is at least 2^-5, 2^-10 (nominal ones); 2^-20, 2^-40; or less
  bool lucky = false;        ///< the answer is what the author of the target wished
  friend bool operator==(const Signature&, const Signature&) = default;

  /// Equal where the signatures are, below 2^19.
  std::uint32_t key() const;
};

/// No value where there is nothing to find: a right answer with finite numbers that are near the exact ones.
std::optional<Signature> signature(const Examination& examination, Wish wish = Wish::none);

/// Of an examination with margins; and the bucket, as the signature has it.
std::pair<Conditioning, unsigned char> conditioning(const Examination& examination);

/// How far t, u and v of a hit may be off without being displaced: as lengths 2^-10 of the longest edge; and t by a few
/// of its own ulps, which of a small triangle far away may be more than that, or by what margins() may be off itself.
Coordinates<double> leeway(const Margins& margins, Precision precision);

/// How bad a finding is, in ulps of the largest coordinate: of what is displaced by how much, else severity_ulps().
double finding_ulps(const Examination& examination, const Signature& found);

/// One word: "false-hit-bc-nominal-c1", "false-miss-ab-by-t-grazing-c3-lucky".
std::string to_word(const Signature& signature);

}  // namespace plumbline
