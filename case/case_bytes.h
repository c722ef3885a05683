// A fuzzer's input: a case of one triangle as a fixed number of bytes, of which every string means one. Little-endian
// numbers of the input's precision, 4 or 8 bytes each:
//   ray space      17: origin, direction, a, b, c, t_min, t_max
//   target space   12: a, b, c, tolerance, standoff and, an unsigned integer, which target, modulo 28, in the order
//                  of targets.h
// In the target space the ray follows from the rest, so that the search is for triangles and distances.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "case/case.h"

namespace plumbline {

enum class Space : unsigned char { ray, target };
inline constexpr std::array<std::string_view, 2> space_names = {"ray", "target"};
constexpr std::string_view name(Space s) { return space_names[static_cast<unsigned>(s)]; }

/// Which numbers an input may hold.
enum class Domain : unsigned char {
  nominal,  ///< a coordinate is 0 or 2^e <= |x| < 2^20, with e = -40 in binary64 and -30 in binary32, so that kernels
            ///< round, but neither over- nor underflow (in binary32, hardly ever); a bound is that, or t_min = -inf,
            ///< t_max = inf; a tolerance or standoff is that, and positive
  full,     ///< a coordinate is any finite number, a tolerance or standoff a positive one; a bound may be infinite
};
inline constexpr std::array<std::string_view, 2> domain_names = {"nominal", "full"};
constexpr std::string_view name(Domain d) { return domain_names[static_cast<unsigned>(d)]; }

/// Targets in the order of targets.h, of one tolerance: 4 interior, 6 vertex_edge, 18 at the tolerance.
inline constexpr unsigned targets_of_a_triangle = 28, first_target_with_tolerance = 10;
/// Bytes of the longest input.
inline constexpr std::size_t longest_input = 17 * sizeof(double);

/// What the bytes say, and no more.
struct FuzzInput {
  Space space = Space::ray;
  Precision precision = Precision::binary64;
  Triangle triangle;
  Ray ray;               ///< of the ray space; ray_of has that of either
  double tolerance = 0;  ///< these three are of the target space; 0 where the target has none
  double standoff = 0;
  unsigned target = 0;  ///< its index among 4 interior, 6 vertex_edge and 18 at the tolerance
  friend bool operator==(const FuzzInput&, const FuzzInput&) = default;
};

/// 68, 136, 48 or 96.
std::size_t input_size(Space space, Precision precision);

/// Total: bytes.size() == input_size(space, precision) is all it asks. What is outside of the domain is folded into
/// it, sign and fraction kept:
///   nominal   the exponent modulo the number of those that there are, also a subnormal's, an infinity's and a NaN's
///   full      all exponent bits set: the uppermost is cleared
///   a NaN bound is the default, 0 or inf; a tolerance or standoff of zero is the least that there may be.
FuzzInput decode(std::span<const std::byte> bytes, Space space, Precision precision, Domain domain);

/// bytes.size() == input_size(input.space, input.precision). Numbers are rounded to the precision.
void encode(const FuzzInput& input, std::span<std::byte> bytes);

/// Whether decode makes the same of its bytes again, bit for bit. Zero directions and triangles without area are in.
bool in_domain(const FuzzInput& input, Domain domain);

/// The ray that is fired. In the target space, as aim_rays has it with Normal::divide, computed in binary64 and then
/// rounded; it may be beyond the domain, or NaN where the triangle has no area.
Ray ray_of(const FuzzInput& input);

/// Without an id.
Case to_case(const FuzzInput& input);

/// The input in Domain::full whose case this is; of several targets the first. None: not one triangle as a surface,
/// numbers of another precision; in the target space also an aim that is missing or doesn't lead to this ray. In the
/// ray space an aim isn't looked at.
std::optional<FuzzInput> from_case(const Case& what, Space space, Precision precision);

}  // namespace plumbline
