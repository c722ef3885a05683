#include "case/lattice.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/input_error.h"

namespace plumbline {
namespace {

constexpr std::uint64_t max_points = 2'642'245;  // the greatest whose cube is below 2^64

std::vector<double> layers_along(char axis_name, const LatticeAxis& axis) {
  const auto named = [&](const char* what) { return fmt::format("{} along {}", what, axis_name); };
  if (axis.step.digits <= 0)
    throw InputError(
        fmt::format("{}: {} is not positive; give a step such as 1.5", named("step"), to_double(axis.step)));
  if (axis.box.digits <= 0)
    throw InputError(fmt::format("{}: {} is not positive; give a box such as 2", named("box"), to_double(axis.box)));

  int exponent = std::min(axis.box.exponent, axis.step.exponent);
  if (axis.offset.digits != 0) exponent = std::min(exponent, axis.offset.exponent);
  const std::int64_t box = in_units(axis.box, exponent, named("box"));
  const std::int64_t step = in_units(axis.step, exponent, named("step"));
  const std::int64_t offset = in_units(axis.offset, exponent, named("offset"));
  if (step > box)
    throw InputError(fmt::format("{}: {} is larger than the box, {}; give a smaller step or a larger box",
                                 named("step"), to_double(axis.step), to_double(axis.box)));
  const std::int64_t last = box / step;
  if (last >= static_cast<std::int64_t>(max_points))
    throw InputError(
        fmt::format("{}: {} layers are too many; give a larger step or a smaller box", named("step"), last + 1));

  std::vector<double> layers;
  layers.reserve(static_cast<std::size_t>(last) + 1);
  for (std::int64_t k = 0; k <= last; ++k) layers.push_back(to_double({offset + k * step, exponent}));
  if (std::ranges::adjacent_find(layers) != layers.end())
    throw InputError(
        fmt::format("{}: {} is lost beside the offset {}, neighbouring layers are the same double; "
                    "give a larger step or a smaller offset",
                    named("step"), to_double(axis.step), to_double(axis.offset)));
  return layers;
}

LatticePoint point_at(const Lattice& lattice, std::uint64_t index) {
  const std::uint64_t ny = lattice.layers[1].size(), nz = lattice.layers[2].size();
  return {static_cast<std::uint32_t>(index / nz / ny), static_cast<std::uint32_t>(index / nz % ny),
          static_cast<std::uint32_t>(index % nz)};
}

Vec3 coordinates(const Lattice& lattice, const LatticePoint& p) {
  return {lattice.layers[0][p[0]], lattice.layers[1][p[1]], lattice.layers[2][p[2]]};
}

}  // namespace

Lattice make_lattice(const std::array<LatticeAxis, 3>& axes) {
  Lattice lattice;
  std::uint64_t points = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    lattice.layers[i] = layers_along("xyz"[i], axes[i]);
    points *= lattice.layers[i].size();  // at most max_points squared: no overflow
    if (points > max_points)
      throw InputError(
          fmt::format("step: more than {} lattice points; give a larger step or a smaller box", max_points));
  }
  return lattice;
}

std::uint64_t point_count(const Lattice& lattice) {
  return std::uint64_t{lattice.layers[0].size()} * lattice.layers[1].size() * lattice.layers[2].size();
}

std::uint64_t triple_count(const Lattice& lattice) {
  const std::uint64_t n = point_count(lattice);
  return n * n * n;
}

TripleRange triple_range(const Lattice& lattice, std::uint64_t first, std::optional<std::uint64_t> count) {
  const std::uint64_t triples = triple_count(lattice);
  if (first >= triples)
    throw InputError(
        fmt::format("first {}: the lattice has the ordered triples [0, {}); give one of these", first, triples));
  if (count > triples - first)
    throw InputError(fmt::format("count {}: there are only {} ordered triples from {} on; give at most that", *count,
                                 triples - first, first));
  return {first, count ? first + *count : triples};
}

Vec3 offset_of(const Lattice& lattice) { return coordinates(lattice, {0, 0, 0}); }

LatticeTriple triple_at(const Lattice& lattice, std::uint64_t index) {
  const std::uint64_t n = point_count(lattice);
  return {point_at(lattice, index / n / n), point_at(lattice, index / n % n), point_at(lattice, index % n)};
}

bool collinear(const LatticeTriple& triple) {
  // An index is below 2^22, so a difference is too, and a product below 2^44. Scaling the axes keeps lines straight.
  const auto difference = [&](std::size_t to, std::size_t axis) {
    return std::int64_t{triple[to][axis]} - std::int64_t{triple[0][axis]};
  };
  const auto minor = [&](std::size_t i, std::size_t j) {
    return difference(1, i) * difference(2, j) - difference(1, j) * difference(2, i);
  };
  return minor(0, 1) == 0 && minor(1, 2) == 0 && minor(2, 0) == 0;
}

Triangle triangle_of(const Lattice& lattice, const LatticeTriple& triple) {
  return {coordinates(lattice, triple[0]), coordinates(lattice, triple[1]), coordinates(lattice, triple[2])};
}

}  // namespace plumbline
