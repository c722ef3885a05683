#include "mesh/weld.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "case/float_bits.h"

namespace plumbline {
namespace {

auto key(const Vec3& v) { return std::tuple(ordinal(v.x), ordinal(v.y), ordinal(v.z)); }

}  // namespace

Mesh welded(const Mesh& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  std::vector<std::uint32_t> sorted(count);
  std::iota(sorted.begin(), sorted.end(), 0u);
  std::ranges::sort(sorted, {}, [&](std::uint32_t i) { return std::tuple(key(mesh.vertices[i]), i); });

  std::vector<std::uint32_t> first(count);  // of the vertices at the same point
  for (std::uint32_t k = 0; k < count; ++k) {
    const bool same = k > 0 && key(mesh.vertices[sorted[k]]) == key(mesh.vertices[sorted[k - 1]]);
    first[sorted[k]] = same ? first[sorted[k - 1]] : sorted[k];
  }

  Mesh result;
  result.precision = mesh.precision;
  std::vector<std::uint32_t> now(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (first[i] == i) {
      now[i] = static_cast<std::uint32_t>(result.vertices.size());
      result.vertices.push_back(mesh.vertices[i]);
    } else {
      now[i] = now[first[i]];
    }
  }
  result.triangles.reserve(mesh.triangles.size());
  for (const auto [a, b, c] : mesh.triangles) result.triangles.push_back({now[a], now[b], now[c]});
  return result;
}

}  // namespace plumbline
