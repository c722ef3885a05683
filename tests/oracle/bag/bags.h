// Bags for tests: boxes, tetrahedra and random ones on small lattices, where rays often meet edges and vertices.
#pragma once
#include <array>
#include <random>
#include <vector>

#include "case/geometry.h"

namespace plumbline {

/// Oriented outwards: each face of the box as two triangles.
inline std::vector<Triangle> box(const Vec3& low, const Vec3& high) {
  const auto corner = [&](int i) {
    return Vec3{(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
  };
  constexpr std::array<std::array<int, 4>, 6> faces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  std::vector<Triangle> triangles;
  for (const auto& f : faces) {
    triangles.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
    triangles.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
  }
  return triangles;
}

/// Small whole numbers, of which random rays meet many features exactly.
class LatticeBags {
 public:
  LatticeBags(std::uint64_t seed, int reach) : random_(seed), reach_(reach) {}

  Vec3 point() { return {coordinate(), coordinate(), coordinate()}; }
  Triangle triangle() { return {point(), point(), point()}; }
  Ray ray() {
    Vec3 direction;
    while (direction == Vec3{}) direction = point();
    return {point(), direction};
  }
  std::vector<Triangle> bag(int most) {
    std::vector<Triangle> triangles;
    for (auto n = random_() % static_cast<unsigned>(most + 1); n > 0; --n) triangles.push_back(triangle());
    return triangles;
  }
  /// Oriented outwards; of volume 0 as it comes.
  std::vector<Triangle> tetrahedron() {
    Vec3 a = point(), b = point();
    const Vec3 c = point(), d = point();
    const auto volume = [&] {
      const auto minus = [](const Vec3& p, const Vec3& q) { return Vec3{p.x - q.x, p.y - q.y, p.z - q.z}; };
      const Vec3 u = minus(b, a), v = minus(c, a), w = minus(d, a);
      return u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) + u.z * (v.x * w.y - v.y * w.x);
    };
    if (volume() < 0) std::swap(a, b);
    return {{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}};
  }

  std::mt19937_64& random() { return random_; }

 private:
  double coordinate() { return static_cast<double>(random_() % static_cast<unsigned>(2 * reach_ + 1)) - reach_; }

  std::mt19937_64 random_;
  int reach_;
};

}  // namespace plumbline
