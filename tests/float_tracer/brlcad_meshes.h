// Bags of several faces for the BRL-CAD tests, and rays at them.
#pragma once
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "case/case.h"

namespace plumbline {

/// The same on every machine, unlike the distributions of the standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  std::uint64_t below(std::uint64_t n) { return bits_() % n; }
  double within(double low, double high) { return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53); }
  Vec3 vector() { return {within(-1, 1), within(-1, 1), within(-1, 1)}; }

 private:
  std::mt19937_64 bits_;
};

/// Of each kind another one for each call, of any size and place, half of them on a coarse grid.
struct BrlcadMesh {
  std::string kind;
  std::vector<Triangle> triangles;
};
inline constexpr std::size_t brlcad_mesh_kinds = 12;
BrlcadMesh brlcad_mesh(std::size_t kind, Random& random);

/// Around these triangles: every mode, with and without orientation, and every kind of plate.
std::vector<Bag> brlcad_bags(const std::vector<Triangle>& triangles);

/// Through a point of its interior, edges and vertices or an ulp beside: along its normal, an axis, nearly in its
/// plane, to a vertex of any other triangle, or anywhere; of unit length or not; from before, within and behind.
Ray brlcad_ray(const std::vector<Triangle>& triangles, Random& random);

/// The closed meshes, all faces counter-clockwise from outside. Of the sphere, 20 * 4^depth.
std::vector<Triangle> tetrahedron();
std::vector<Triangle> cube();
std::vector<Triangle> icosphere(int depth);

}  // namespace plumbline
