// What a mesh cannot hold, before any ray is traced: without area, twice, open, tangled, inside out, or too small for
// its numbers. Whether a triangle has area is decided exactly. Takes O(n log n): a second for 10^6 triangles.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "mesh/mesh.h"

namespace plumbline {

/// How often something is in a mesh, and the first triangle that has it.
struct Flaw {
  std::uint64_t count = 0;
  std::uint32_t triangle = 0;  ///< where count > 0
  friend bool operator==(const Flaw&, const Flaw&) = default;
};

/// The least length of its kind among the triangles with area, and which has it.
struct LeastLength {
  double ulps = 0;  ///< units in the last place, at the mesh's precision, of its largest coordinate; within 2^-30
  std::uint32_t triangle = 0;
  friend bool operator==(const LeastLength&, const LeastLength&) = default;
};

struct MeshReport {
  std::uint64_t triangles = 0, vertices = 0;
  Precision precision = Precision::binary64;
  double largest_coordinate = 0;        ///< in magnitude
  std::uint64_t isolated_vertices = 0;  ///< of no triangle
  std::uint64_t pieces = 0;             ///< of triangles that hang together by vertices
  Flaw degenerate;                      ///< triangles without area: N = 0 exactly
  Flaw duplicate;                       ///< triangles with the vertices of an earlier one, in whatever order
  // Edges; a triangle that has a vertex twice has none.
  Flaw open;                                  ///< of one triangle
  Flaw non_manifold;                          ///< of three or more
  Flaw misoriented;                           ///< of two that run along it the same way
  bool closed = false;                        ///< there are edges, and none of the three above
  std::optional<LeastLength> edge, altitude;  ///< the least; no value where no triangle has area
  friend bool operator==(const MeshReport&, const MeshReport&) = default;
};

MeshReport report(const Mesh& mesh);

/// Lines for people.
std::string to_text(const MeshReport& report);
/// One JSON object, with the end of its line.
std::string to_json(const MeshReport& report);

}  // namespace plumbline
