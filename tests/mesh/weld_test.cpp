#include "mesh/weld.h"

#include <gmock/gmock.h>

#include "case/float_bits.h"
#include "case/random.h"

namespace plumbline {
namespace {

using testing::ElementsAre;

TEST(Weld, EqualIsEqualInEveryBitButTheSignOfZero) {
  const Vec3 a = {0, 1, 2}, minus = {-0.0, 1, 2}, next = {0x0.0000000000001p-1022, 1, 2}, other = {0, 1, -2};
  const Mesh mesh = {{a, other, minus, next, a}, {{0, 1, 3}, {2, 4, 1}}, Precision::binary64};
  const Mesh result = welded(mesh);
  EXPECT_THAT(result.vertices, ElementsAre(a, other, next));
  EXPECT_FALSE(is_negative(result.vertices[0].x)) << "the first stays";
  EXPECT_THAT(result.triangles, ElementsAre(Corners{0, 1, 2}, Corners{0, 0, 1}));
  EXPECT_EQ(result.precision, Precision::binary64);
}

TEST(Weld, KeepsTheSignOfTheFirst) {
  const Mesh result = welded({{{-0.0, 0, 0}, {0, 0, 0}}, {{1, 1, 0}}, Precision::binary32});
  ASSERT_EQ(result.vertices.size(), 1u);
  EXPECT_TRUE(is_negative(result.vertices[0].x));
}

TEST(Weld, VerticesOfNoTriangleStay) {
  const Mesh mesh = {{{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}}, {{0, 2, 3}}, Precision::binary32};
  EXPECT_EQ(welded(mesh), mesh);
}

TEST(Weld, AgreesWithTheQuadraticWay) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed, 7);
    Mesh mesh;
    for (int i = 0; i < 60; ++i) {
      const auto coordinate = [&] {
        return static_cast<double>(random.integer(-1, 1)) * (random.chance(2) ? 1 : -1);
      };
      mesh.vertices.push_back({coordinate(), coordinate(), coordinate()});
    }
    for (int i = 0; i < 40; ++i) {
      const auto corner = [&] { return static_cast<std::uint32_t>(random.below(60)); };
      mesh.triangles.push_back({corner(), corner(), corner()});
    }
    const Mesh result = welded(mesh);
    for (std::size_t i = 0; i < result.vertices.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) EXPECT_NE(result.vertices[i], result.vertices[k]) << "seed " << seed;
    ASSERT_EQ(result.triangles.size(), mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      EXPECT_EQ(triangle_at(result, i), triangle_at(mesh, i)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace plumbline
