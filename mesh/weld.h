// Vertices that are the same point become the same vertex: exactly, without a tolerance.
#pragma once
#include "mesh/mesh.h"

namespace plumbline {

/// Vertices with equal coordinates, -0 and 0 being equal, become the first of them. The order stays, and vertices
/// that no triangle has stay too. Takes O(n log n).
Mesh welded(const Mesh& mesh);

}  // namespace plumbline
