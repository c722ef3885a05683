#include "mesh/mesh.h"

#include <algorithm>

#include "case/precision.h"

namespace plumbline {

Precision precision_of(std::span<const Vec3> vertices) {
  const bool narrow =
      std::ranges::all_of(vertices, [](const Vec3& v) { return v == at_precision(v, Precision::binary32); });
  return narrow ? Precision::binary32 : Precision::binary64;
}

Bag to_bag(const Mesh& mesh) {
  Bag bag;
  bag.triangles.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) bag.triangles.push_back(triangle_at(mesh, i));
  return bag;
}

}  // namespace plumbline
