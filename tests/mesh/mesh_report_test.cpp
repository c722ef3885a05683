#include "mesh/mesh_report.h"

#include <gtest/gtest.h>

#include "case/random.h"
#include "oracle/classify.h"

namespace plumbline {
namespace {

Mesh mesh_of(std::vector<Vec3> vertices, std::vector<Corners> triangles) {
  const Precision precision = precision_of(vertices);
  return {std::move(vertices), std::move(triangles), precision};
}

const std::vector<Vec3> four = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<Corners> tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

TEST(MeshReport, OfATetrahedron) {
  const MeshReport found = report(mesh_of(four, tetrahedron));
  EXPECT_EQ(found.triangles, 4u);
  EXPECT_EQ(found.vertices, 4u);
  EXPECT_EQ(found.precision, Precision::binary32);
  EXPECT_EQ(found.largest_coordinate, 1);
  EXPECT_EQ(found.pieces, 1u);
  EXPECT_EQ(found.isolated_vertices, 0u);
  EXPECT_TRUE(found.closed);
  for (const Flaw& flaw : {found.degenerate, found.duplicate, found.open, found.non_manifold, found.misoriented})
    EXPECT_EQ(flaw, Flaw{});
  EXPECT_NEAR(found.edge->ulps, 0x1p23, 1e-3);  // 1, in units of 2^-23
  EXPECT_EQ(found.edge->triangle, 0u);
  EXPECT_NEAR(found.altitude->ulps, 0x1.6a09e667f3bcdp22, 1e-3);  // sqrt(1/2), onto the edges of length sqrt(2)
}

TEST(MeshReport, OpenEdges) {
  const MeshReport found = report(mesh_of(four, {tetrahedron[0], tetrahedron[1], tetrahedron[2]}));
  EXPECT_EQ(found.open, (Flaw{3, 0}));
  EXPECT_FALSE(found.closed);
  EXPECT_EQ(report(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})).open, (Flaw{3, 0}));
}

TEST(MeshReport, MisorientedEdges) {
  std::vector<Corners> triangles = tetrahedron;
  std::swap(triangles[3][0], triangles[3][1]);
  const MeshReport found = report(mesh_of(four, triangles));
  EXPECT_EQ(found.misoriented, (Flaw{3, 0}));
  EXPECT_EQ(found.open.count + found.non_manifold.count, 0u);
  EXPECT_FALSE(found.closed);
}

TEST(MeshReport, NonManifoldEdges) {
  std::vector<Vec3> five = four;
  five.push_back({0, 0, -1});
  const MeshReport found = report(mesh_of(five, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));
  EXPECT_EQ(found.non_manifold, (Flaw{1, 0}));
  EXPECT_EQ(found.open.count, 6u);
  EXPECT_FALSE(found.closed);
}

TEST(MeshReport, DuplicatesInWhateverOrder) {
  std::vector<Corners> triangles = tetrahedron;
  triangles.push_back({2, 1, 0});
  triangles.push_back({3, 2, 1});
  const MeshReport found = report(mesh_of(four, triangles));
  EXPECT_EQ(found.duplicate, (Flaw{2, 4}));
  EXPECT_FALSE(found.closed);
}

TEST(MeshReport, PiecesAndIsolatedVertices) {
  std::vector<Vec3> vertices = four;
  for (const Vec3& v : four) vertices.push_back({v.x + 5, v.y, v.z});
  vertices.push_back({9, 9, 9});
  std::vector<Corners> triangles = tetrahedron;
  for (const auto& [a, b, c] : tetrahedron) triangles.push_back({a + 4, b + 4, c + 4});
  const MeshReport apart = report(mesh_of(vertices, triangles));
  EXPECT_EQ(apart.pieces, 2u);
  EXPECT_EQ(apart.isolated_vertices, 1u);
  EXPECT_TRUE(apart.closed);
  triangles.push_back({3, 3, 5});  // a triangle that has a vertex twice joins, and has no edges
  const MeshReport joined = report(mesh_of(vertices, triangles));
  EXPECT_EQ(joined.pieces, 1u);
  EXPECT_EQ(joined.degenerate, (Flaw{1, 8}));
  EXPECT_TRUE(joined.closed);
}

// Collinear in doubles is not what decides: the point 0.1, 0.2, 0.3 of a line through 0 and 1, 2, 3 is off it.
TEST(MeshReport, DegenerateIsDecidedExactly) {
  const double ulp = 0x1p-52;
  const std::vector<Vec3> vertices = {{0, 0, 0},       {1, 1, 1}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5 + ulp / 2},
                                      {0.1, 0.2, 0.3}, {1, 2, 3}};
  const MeshReport found = report(mesh_of(vertices, {{0, 1, 3}, {0, 1, 2}, {0, 4, 5}, {2, 2, 2}}));
  EXPECT_EQ(found.degenerate, (Flaw{2, 1}));
  EXPECT_EQ(found.altitude->triangle, 2u);
}

TEST(MeshReport, AllDegenerateHasNoLeastLengths) {
  const MeshReport found = report(mesh_of({{0, 0, 0}}, {{0, 0, 0}}));
  EXPECT_EQ(found.degenerate, (Flaw{1, 0}));
  EXPECT_FALSE(found.edge);
  EXPECT_FALSE(found.altitude);
  EXPECT_FALSE(found.closed);
  EXPECT_NE(to_json(found).find("\"least_edge\":null"), std::string::npos);
}

// Whichever axis the plane holds, the triangle has area.
TEST(MeshReport, PlanesThroughTheAxes) {
  const std::vector<Vec3> vertices = {{0, 0, 0},   {1, 0, 0},   {0, 1, 0},  {0, 0, 1},
                                      {-1, -1, 0}, {-1, 0, -1}, {0, -1, -1}};
  const MeshReport found =
      report(mesh_of(vertices, {{4, 1, 2}, {5, 1, 3}, {6, 2, 3}, {0, 1, 2}, {0, 2, 3}, {0, 1, 3}}));
  EXPECT_EQ(found.degenerate.count, 0u);
}

TEST(MeshReport, FeaturesInUlpsOfTheLargestCoordinate) {
  // binary32, the largest is 2^20: an ulp is 2^-3. The short edge is 1/4 long.
  const MeshReport narrow =
      report(mesh_of({{0x1p20, 0, 0}, {0, 0, 0}, {0, 0.25, 0}, {0, 9, 9}}, {{1, 3, 0}, {0, 1, 2}}));
  EXPECT_EQ(narrow.precision, Precision::binary32);
  EXPECT_EQ(*narrow.edge, (LeastLength{2, 1}));
  EXPECT_NEAR(narrow.altitude->ulps, 2, 1e-9);
  // One coordinate is no float: an ulp is 2^-32.
  const MeshReport wide = report(mesh_of({{0x1p20, 0, 0}, {0, 0, 0x1p-600}, {0, 0.25, 0}}, {{0, 1, 2}}));
  EXPECT_EQ(wide.precision, Precision::binary64);
  EXPECT_EQ(wide.edge->ulps, 0x1p30);
}

TEST(MeshReport, LengthsNeitherOverNorUnderflow) {
  const double huge = 0x1.8p1023, tiny = 0x0.0000000000001p-1022;
  const MeshReport far = report(mesh_of({{-huge, 0, 0}, {huge, 0, 0}, {0, huge, 0}}, {{0, 1, 2}}));
  EXPECT_NEAR(far.edge->ulps, 0x1.8p52 * 0x1.6a09e667f3bcdp0, 64);
  EXPECT_NEAR(far.altitude->ulps, 0x1.8p52, 64);
  const MeshReport small = report(mesh_of({{0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}}, {{0, 1, 2}}));
  EXPECT_EQ(small.degenerate.count, 0u);
  EXPECT_EQ(small.edge->ulps, 1);
}

// Against another exact judge: the class that classify gives to a ray through nowhere in particular.
TEST(MeshReport, DegenerateAgreesWithClassify) {
  const std::uint64_t seed = 1;
  RecordProperty("seed", std::to_string(seed));
  Random random(seed, 8);
  std::uint64_t flat = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto coordinate = [&] { return static_cast<double>(random.integer(-2, 2)) * 0.1; };
    std::vector<Vec3> vertices;
    for (int k = 0; k < 3; ++k) vertices.push_back({coordinate(), coordinate(), coordinate()});
    const Mesh mesh = mesh_of(vertices, {{0, 1, 2}});
    const bool degenerate = report(mesh).degenerate.count == 1;
    const Truth truth = classify(triangle_at(mesh, 0), Ray{{7, 8, 9}, {0.3, 0.2, 0.7}});
    EXPECT_EQ(degenerate, truth.hit_class == HitClass::degenerate) << "seed " << seed << ", triangle " << i;
    flat += degenerate;
  }
  EXPECT_GT(flat, 100u);
  EXPECT_LT(flat, 10000u);
}

TEST(MeshReport, AsTextAndAsJson) {
  const MeshReport found = report(mesh_of(four, {tetrahedron[0], tetrahedron[1], tetrahedron[2]}));
  EXPECT_EQ(to_text(found),
            "triangles               3\n"
            "vertices                4\n"
            "coordinates             binary32\n"
            "largest coordinate      1\n"
            "pieces                  1\n"
            "isolated vertices       0\n"
            "degenerate triangles    0\n"
            "duplicate triangles     0\n"
            "open edges              3, the first at triangle 0\n"
            "non-manifold edges      0\n"
            "misoriented edges       0\n"
            "closed                  no\n"
            "least edge              8.39e+06 ulps, of triangle 0\n"
            "least altitude          5.93e+06 ulps, of triangle 0\n");
  const std::string json = to_json(found);
  EXPECT_NE(json.find("\"open_edges\":{\"count\":3,\"triangle\":0}"), std::string::npos) << json;
  EXPECT_NE(json.find("\"misoriented_edges\":{\"count\":0,\"triangle\":null}"), std::string::npos) << json;
  EXPECT_TRUE(json.ends_with("}\n"));
}

}  // namespace
}  // namespace plumbline
