#include "mesh/write_mesh.h"

#include <gtest/gtest.h>

#include "case/float_bits.h"
#include "case/random.h"
#include "mesh/sphere.h"
#include "tests/case/error_of.h"

namespace plumbline {
namespace {

std::string written(const Mesh& mesh, MeshFormat format) {
  std::string out;
  write_mesh(mesh, format, [&out](std::string_view part) { out += part; });
  return out;
}

Mesh read_back(const Mesh& mesh, MeshFormat format) { return parse_mesh(written(mesh, format), format, "m"); }

void expect_same_bits(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a, b);  // which takes -0 for 0
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z})
      ASSERT_EQ(to_bits(a.vertices[i].*axis), to_bits(b.vertices[i].*axis)) << i;
}

TEST(WriteMesh, AsBytes) {
  const Mesh mesh = {{{0, -0.0, 1}, {2, 0, 0}, {0, 3, 0}}, {{2, 0, 1}}, Precision::binary32};
  using namespace std::string_literals;
  EXPECT_EQ(
      written(mesh, MeshFormat::ply),
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar uint vertex_indices\nend_header\n"
      "\0\0\0\0\0\0\0\x80\0\0\x80\x3f"s
      "\0\0\0\x40\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x40\x40\0\0\0\0\3\2\0\0\0\0\0\0\0\1\0\0\0"s);
  EXPECT_EQ(written(mesh, MeshFormat::obj), "v 0 -0 1\nv 2 0 0\nv 0 3 0\nf 3 1 2\n");
  EXPECT_EQ(error_of([&] { written(mesh, MeshFormat::stl); }),
            "an STL holds floats only and is not written; name the file .ply or .obj");
}

TEST(WriteMesh, AnyFiniteBitsReadBack) {
  const std::uint64_t seed = 5;
  RecordProperty("seed", std::to_string(seed));
  Random random(seed, 0);
  for (const Precision precision : {Precision::binary32, Precision::binary64})
    for (const MeshFormat format : {MeshFormat::ply, MeshFormat::obj}) {
      Mesh mesh;
      const auto coordinate = [&]() -> double {
        while (true) {
          const double x = precision == Precision::binary64
                               ? from_bits<double>(random.bits())
                               : from_bits<float>(static_cast<std::uint32_t>(random.bits()));
          if (is_finite(x)) return x;
        }
      };
      for (int i = 0; i < 3000; ++i) mesh.vertices.push_back({coordinate(), coordinate(), coordinate()});
      for (std::uint32_t i = 0; i < 3000; ++i) mesh.triangles.push_back({i, (i + 7) % 3000, (i + 1) % 3000});
      mesh.precision = precision_of(mesh.vertices);
      EXPECT_EQ(mesh.precision, precision);
      expect_same_bits(read_back(mesh, format), mesh);
    }
}

TEST(WriteMesh, SpheresReadBack) {
  for (const Precision precision : {Precision::binary32, Precision::binary64})
    for (const MeshFormat format : {MeshFormat::ply, MeshFormat::obj}) {
      const Mesh mesh = make_sphere({20000, 0.01, 9, precision});
      expect_same_bits(read_back(mesh, format), mesh);
    }
}

}  // namespace
}  // namespace plumbline
