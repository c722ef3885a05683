// A mesh: triangles that share their vertices by index. Of every Mesh it holds that all coordinates are finite, that
// every index is below the number of vertices, and that `precision` is binary32 exactly if every coordinate is a
// binary32 number. Nothing else is promised: triangles may be degenerate, edges open, vertices unused.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "case/case.h"

namespace plumbline {

/// The corners a, b, c of a triangle as indices of vertices.
using Corners = std::array<std::uint32_t, 3>;

struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<Corners> triangles;
  Precision precision = Precision::binary64;
  friend bool operator==(const Mesh&, const Mesh&) = default;
};

/// The narrowest precision that holds all of them; of none, binary32.
Precision precision_of(std::span<const Vec3> vertices);

inline Triangle triangle_at(const Mesh& mesh, std::size_t i) {
  const auto [a, b, c] = mesh.triangles[i];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

/// The triangles in their order, as surfaces.
Bag to_bag(const Mesh& mesh);

}  // namespace plumbline
