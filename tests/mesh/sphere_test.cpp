#include "mesh/sphere.h"

#include <gtest/gtest.h>

#include <cmath>

#include "case/float_bits.h"
#include "case/precision.h"
#include "mesh/mesh_report.h"
#include "mesh/weld.h"

namespace plumbline {
namespace {

// The sum of 6 times the volumes over 0, all of them positive where every triangle is counter-clockwise from outside.
bool all_face_outwards(const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = triangle_at(mesh, i);
    const double volume =
        a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
    if (!(volume > 0)) return false;
  }
  return true;
}

std::uint64_t hash(const Mesh& mesh) {
  std::uint64_t h = 0;
  const auto add = [&h](std::uint64_t bits) { h = (h ^ bits) * 0x9e3779b97f4a7c15u; };
  for (const Vec3& v : mesh.vertices)
    for (const double x : {v.x, v.y, v.z}) add(to_bits(x));
  for (const Corners& corners : mesh.triangles)
    for (const std::uint32_t corner : corners) add(corner);
  return h;
}

TEST(Sphere, HasTheNextTwentySquares) {
  for (const auto& [asked, made] : {std::pair(1, 20), {20, 20}, {21, 80}, {80, 80}, {81, 180}, {500000, 505620}}) {
    const Mesh mesh = make_sphere({.triangles = static_cast<std::uint64_t>(asked)});
    EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(made));
    EXPECT_EQ(mesh.vertices.size(), static_cast<std::size_t>(made / 2 + 2)) << "Euler: V - 3F/2 + F = 2";
  }
}

TEST(Sphere, IsClosedAndFacesOutwards) {
  for (const std::uint64_t triangles : {20u, 80u, 180u, 320u, 5000u})
    for (const Precision precision : {Precision::binary32, Precision::binary64}) {
      const Mesh mesh = make_sphere({triangles, 0.01, 3, precision});
      EXPECT_EQ(mesh.precision, precision);
      EXPECT_EQ(welded(mesh), mesh) << "no vertex twice";
      const MeshReport found = report(mesh);
      EXPECT_TRUE(found.closed);
      EXPECT_EQ(found.pieces, 1u);
      EXPECT_EQ(found.isolated_vertices + found.degenerate.count + found.duplicate.count, 0u);
      EXPECT_TRUE(all_face_outwards(mesh)) << triangles;
    }
}

TEST(Sphere, RadiiAreWithinTheJitter) {
  const auto radii = [](const Mesh& mesh) {
    double least = 10, most = 0;
    for (const Vec3& v : mesh.vertices) {
      const double r = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
      least = std::min(least, r);
      most = std::max(most, r);
    }
    return std::pair(least, most);
  };
  const auto [low, high] = radii(make_sphere({.triangles = 2000, .jitter = 0.25}));
  EXPECT_GE(low, 0.75 - 0x1p-50);
  EXPECT_LT(low, 0.76);
  EXPECT_LE(high, 1.25 + 0x1p-50);
  EXPECT_GT(high, 1.24);
  const auto [one, too] = radii(make_sphere({.triangles = 2000}));
  EXPECT_NEAR(one, 1, 0x1p-50);
  EXPECT_NEAR(too, 1, 0x1p-50);
}

// The bits that clang and g++ have to agree on.
TEST(Sphere, SameBitsEverywhere) {
  EXPECT_EQ(hash(make_sphere({.triangles = 20})), 9642858752964924356u);
  EXPECT_EQ(hash(make_sphere({2000, 0.125, 42, Precision::binary64})), 5938452055774687278u);
  EXPECT_EQ(hash(make_sphere({2000, 0.125, 42, Precision::binary32})), 17120562812454428208u);
  EXPECT_NE(hash(make_sphere({2000, 0.125, 43, Precision::binary64})), 5938452055774687278u);
}

}  // namespace
}  // namespace plumbline
