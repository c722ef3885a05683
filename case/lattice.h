// The report's lattice: every ordered triple of the points offset + k * step of a box, addressed by index, never
// stored. Box, step and offset are exact decimals per axis, so that the number of layers is exact; coordinates are the
// doubles nearest to the exact ones; what is collinear is decided on the integers k.
//
// Order: points by x, then y, then z (z innermost); triples by a, then b, then c (c innermost), which is the order of
// the report's nine nested loops. Units of length are the caller's.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "case/decimal.h"
#include "case/geometry.h"

namespace plumbline {

struct LatticeAxis {
  Decimal box, step, offset;
};

struct Lattice {
  std::array<std::vector<double>, 3> layers;  ///< the coordinates along x, y and z
  friend bool operator==(const Lattice&, const Lattice&) = default;
};

/// Which layer along x, y and z.
using LatticePoint = std::array<std::uint32_t, 3>;
/// a, b, c.
using LatticeTriple = std::array<LatticePoint, 3>;

/// floor(box / step) + 1 layers along each axis. Throws InputError, naming the axis and the fix, unless
/// 0 < step <= box, the triples can be counted in 64 bits, and the layers are distinct doubles.
Lattice make_lattice(const std::array<LatticeAxis, 3>& axes);

std::uint64_t point_count(const Lattice& lattice);
std::uint64_t triple_count(const Lattice& lattice);

/// The ordered triples [first, end).
struct TripleRange {
  std::uint64_t first = 0, end = 0;
};

/// `count` triples from `first` on, or all that follow. Throws InputError where the lattice has not as many.
TripleRange triple_range(const Lattice& lattice, std::uint64_t first, std::optional<std::uint64_t> count);

/// The first point, where all k are 0.
Vec3 offset_of(const Lattice& lattice);

/// index < triple_count(lattice). Takes the same time for any index.
LatticeTriple triple_at(const Lattice& lattice, std::uint64_t index);

/// Exact. Coinciding points are collinear.
bool collinear(const LatticeTriple& triple);

Triangle triangle_of(const Lattice& lattice, const LatticeTriple& triple);

}  // namespace plumbline
