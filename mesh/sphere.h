// A closed mesh of any size: a sphere around the origin whose radius is jittered from vertex to vertex.
#pragma once
#include <cstdint>

#include "mesh/mesh.h"

namespace plumbline {

struct SphereOptions {
  std::uint64_t triangles = 20;  ///< at least so many: the next 20 n^2. From 1 to most_sphere_triangles
  double jitter = 0;             ///< radii are uniform in 1 +- jitter; 0 <= jitter < 1
  std::uint64_t seed = 1;
  Precision precision = Precision::binary64;  ///< coordinates are rounded to it
};
inline constexpr std::uint64_t most_sphere_triangles = 100'000'000;

/// Each face of an icosahedron divided into n^2 triangles, pushed out onto the sphere. Every edge is of two
/// triangles, all counter-clockwise seen from outside. The same options give the same bits on every machine: nothing
/// but + - * / and square roots, which IEEE 754 rounds.
Mesh make_sphere(const SphereOptions& options);

}  // namespace plumbline
