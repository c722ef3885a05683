#include "mesh/sphere.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "case/precision.h"
#include "case/random.h"

namespace plumbline {
namespace {

// The corners of three golden rectangles, and between them the faces, counter-clockwise seen from outside.
const double golden = (1 + std::sqrt(5.0)) / 2;
const std::array<Vec3, 12> corners = {{{-1, golden, 0},
                                       {1, golden, 0},
                                       {-1, -golden, 0},
                                       {1, -golden, 0},
                                       {0, -1, golden},
                                       {0, 1, golden},
                                       {0, -1, -golden},
                                       {0, 1, -golden},
                                       {golden, 0, -1},
                                       {golden, 0, 1},
                                       {-golden, 0, -1},
                                       {-golden, 0, 1}}};
constexpr std::array<Corners, 20> faces = {{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                            {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                            {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                            {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};

class Subdivision {
 public:
  Subdivision(std::uint32_t n, Mesh& mesh) : n_(n), mesh_(mesh) {
    mesh.vertices.assign(corners.begin(), corners.end());
    for (const Corners& face : faces) divide(face);
  }

 private:
  // The points of a face lie in rows: row i has i + 1, from row 0, which is its first corner.
  void divide(const Corners& face) {
    const auto [a, b, c] = face;
    const std::uint32_t ab = edge(a, b), bc = edge(b, c), ac = edge(a, c);
    const auto inner = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (std::uint32_t i = 2; i < n_; ++i)
      for (std::uint32_t j = 1; j < i; ++j) mesh_.vertices.push_back(between(n_ - i, a, i - j, b, j, c));
    const auto on_edge = [this](std::uint32_t first, std::uint32_t from, std::uint32_t to, std::uint32_t k) {
      return first + (from < to ? k : n_ - k) - 1;
    };
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
      if (i == 0) return a;
      if (i == n_ && j == 0) return b;
      if (i == n_ && j == n_) return c;
      if (j == 0) return on_edge(ab, a, b, i);
      if (j == i) return on_edge(ac, a, c, i);
      if (i == n_) return on_edge(bc, b, c, j);
      return inner + (i - 2) * (i - 1) / 2 + j - 1;
    };
    for (std::uint32_t i = 0; i < n_; ++i)
      for (std::uint32_t j = 0; j <= i; ++j) {
        mesh_.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        if (j < i) mesh_.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }

  // The first of the n - 1 points of an edge, which two faces have in common,
  // from the lesser corner on.
  std::uint32_t edge(std::uint32_t a, std::uint32_t b) {
    const auto [from, to] = std::minmax(a, b);
    const auto [place, is_new] = edges_.try_emplace({from, to}, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new)
      for (std::uint32_t k = 1; k < n_; ++k) mesh_.vertices.push_back(between(n_ - k, from, k, to, 0, to));
    return place->second;
  }

  static Vec3 between(std::uint32_t i, std::uint32_t a, std::uint32_t j, std::uint32_t b, std::uint32_t k,
                      std::uint32_t c) {
    const Vec3 p = corners[a], q = corners[b], r = corners[c];
    return {i * p.x + j * q.x + k * r.x, i * p.y + j * q.y + k * r.y, i * p.z + j * q.z + k * r.z};
  }

  std::uint32_t n_;
  Mesh& mesh_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges_;
};

}  // namespace

Mesh make_sphere(const SphereOptions& options) {
  std::uint32_t n = 1;
  while (20 * std::uint64_t{n} * n < options.triangles) ++n;
  Mesh mesh;
  mesh.vertices.reserve(10 * std::size_t{n} * n + 2);
  mesh.triangles.reserve(20 * std::size_t{n} * n);
  Subdivision(n, mesh);
  Random random(Random(options.seed, 0).bits(), 0);
  for (Vec3& v : mesh.vertices) {
    const double scale = (1 + options.jitter * random.unit()) / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    v = at_precision(Vec3{v.x * scale, v.y * scale, v.z * scale}, options.precision);
  }
  mesh.precision = precision_of(mesh.vertices);
  return mesh;
}

}  // namespace plumbline
