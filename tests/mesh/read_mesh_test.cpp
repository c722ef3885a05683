#include "mesh/read_mesh.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <bit>
#include <fstream>

#include "case/float_bits.h"
#include "tests/case/error_of.h"
#include "tests/fuzz/scratch.h"

namespace plumbline {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Mesh parse(const std::string& bytes, MeshFormat format) { return parse_mesh(bytes, format, "m"); }
Mesh obj(const std::string& bytes) { return parse(bytes, MeshFormat::obj); }
Mesh ply(const std::string& bytes) { return parse(bytes, MeshFormat::ply); }
Mesh stl(const std::string& bytes) { return parse(bytes, MeshFormat::stl); }
std::string obj_error(const std::string& bytes) {
  return error_of([&] { obj(bytes); });
}
std::string ply_error(const std::string& bytes) {
  return error_of([&] { ply(bytes); });
}
std::string stl_error(const std::string& bytes) {
  return error_of([&] { stl(bytes); });
}

template <class Value>
std::string bytes_of(Value value, std::endian order = std::endian::little) {
  auto bits = std::bit_cast<std::array<char, sizeof(Value)>>(value);
  if (order == std::endian::big) std::ranges::reverse(bits);
  return {bits.begin(), bits.end()};
}

// ---- bits ----

const std::vector<double> hard = {0x1.999999999999ap-4,    0x1.fffffffffffffp+1023,
                                  0x0.0000000000001p-1022, 0x1.0000000000001p+0,
                                  -0x1.23456789abcdep-300, 0x1p-1022,
                                  0x1.5555555555555p-2,    -0.0,
                                  0x1.921fb54442d18p+1};

TEST(ReadMesh, DecimalsAreRoundedToTheNearestDouble) {
  const Mesh mesh = obj("v 0.1 1.7976931348623157e308 5e-324\nv 1.0000000000000002 +2 1e-400\nv .5 1. -0\nf 1 2 3\n");
  EXPECT_EQ(mesh.vertices[0], (Vec3{0x1.999999999999ap-4, 0x1.fffffffffffffp+1023, 0x0.0000000000001p-1022}));
  EXPECT_EQ(mesh.vertices[1], (Vec3{0x1.0000000000001p+0, 2, 0}));
  EXPECT_EQ(mesh.vertices[2], (Vec3{0.5, 1, 0}));
  EXPECT_TRUE(is_negative(mesh.vertices[2].z));
  EXPECT_EQ(mesh.precision, Precision::binary64);
  // Half way between 1 and the next, and a digit beyond: ties to even, and up.
  const Mesh ties =
      obj("v 1.00000000000000011102230246251565404236316680908203125 0 0\n"
          "v 1.00000000000000011102230246251565404236316680908203126 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(ties.vertices[0].x, 1);
  EXPECT_EQ(ties.vertices[1].x, 0x1.0000000000001p+0);
}

TEST(ReadMesh, FloatsOfAnAsciiPlyAreRoundedOnce) {
  // By way of a double it would be 1, a tie to even.
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty {} x\nproperty {} y\nproperty {} z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n1.00000005960464478 0 0\n0.1 1 0\n0 0 1\n3 0 1 2\n";
  const Mesh narrow = ply(fmt::format(fmt::runtime(header), "float", "float", "float"));
  EXPECT_EQ(narrow.vertices[0].x, 0x1.000002p+0);
  EXPECT_EQ(narrow.vertices[1].x, 0x1.99999ap-4);
  EXPECT_EQ(narrow.precision, Precision::binary32);
  const Mesh wide = ply(fmt::format(fmt::runtime(header), "double", "float64", "double"));
  EXPECT_EQ(wide.vertices[1].x, 0x1.999999999999ap-4);
  EXPECT_EQ(wide.precision, Precision::binary64);
}

std::string binary_ply(std::endian order, std::string_view type, const auto& values) {
  std::string bytes = fmt::format(
      "ply\r\nformat binary_{}_endian 1.0\r\ncomment end_header\r\nelement vertex 3\r\nproperty uchar "
      "red\r\nproperty {} x\r\n"
      "property {} y\r\nproperty {} z\r\nproperty list int short list_of_mine\r\nelement face 1\r\n"
      "property list ushort uint vertex_index\r\nproperty float quality\r\nelement other 2\r\nproperty double "
      "what\r\n"
      "end_header\r\n",
      order == std::endian::little ? "little" : "big", type, type, type);
  for (std::size_t i = 0; i < 3; ++i) {
    bytes += '\xff';
    for (std::size_t k = 0; k < 3; ++k) bytes += bytes_of(values[3 * i + k], order);
    bytes += bytes_of(std::int32_t{1}, order) + bytes_of(std::int16_t{-1}, order);
  }
  bytes += bytes_of(std::uint16_t{3}, order);
  for (const std::uint32_t corner : {2u, 0u, 1u}) bytes += bytes_of(corner, order);
  return bytes + bytes_of(1.f, order) + bytes_of(1.0, order) + bytes_of(2.0, order);
}

TEST(ReadMesh, BinaryPliesBitForBit) {
  std::vector<float> floats;
  for (const double x : hard)
    floats.push_back(is_finite(static_cast<float>(x)) ? static_cast<float>(x) : 0x1.fffffep+127f);
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const Mesh wide = ply(binary_ply(order, "double", hard));
    const Mesh narrow = ply(binary_ply(order, "float32", floats));
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 w = wide.vertices[i], n = narrow.vertices[i];
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(to_bits(std::array{w.x, w.y, w.z}[k]), to_bits(hard[3 * i + k]));
        EXPECT_EQ(to_bits(std::array{n.x, n.y, n.z}[k]), to_bits(double{floats[3 * i + k]}));
      }
    }
    EXPECT_THAT(wide.triangles, ElementsAre(Corners{2, 0, 1}));
    EXPECT_EQ(wide.precision, Precision::binary64);
    EXPECT_EQ(narrow.precision, Precision::binary32);
  }
}

std::string binary_stl(std::uint32_t promised, std::vector<std::array<float, 9>> facets,
                       std::string header = "solid of facet") {
  header.resize(80, ' ');
  std::string bytes = header + bytes_of(promised);
  for (const auto& facet : facets) {
    bytes += bytes_of(std::numeric_limits<float>::quiet_NaN()) + bytes_of(0.f) + bytes_of(0.f);  // nobody's business
    for (const float x : facet) bytes += bytes_of(x);
    bytes += "\xff\xff";
  }
  return bytes;
}

TEST(ReadMesh, BinaryStlBitForBitAndWelded) {
  const float least = 0x1p-149f, most = 0x1.fffffep+127f;
  const Mesh mesh =
      stl(binary_stl(2, {{0, least, 0, most, 0, 0, 0, 0, 0.1f}, {most, -0.f, 0, -0.f, least, 0, 1, 1, 1}}));
  EXPECT_THAT(mesh.vertices, ElementsAre(Vec3{0, 0x1p-149, 0}, Vec3{0x1.fffffep+127, 0, 0}, Vec3{0, 0, 0x1.99999ap-4},
                                         Vec3{1, 1, 1}));
  EXPECT_THAT(mesh.triangles, ElementsAre(Corners{0, 1, 2}, Corners{1, 0, 3}));
  EXPECT_EQ(mesh.precision, Precision::binary32);
}

const std::string ascii_facet =
    "  facet normal 0 0 nan\n    outer loop\n      vertex 0 0 0\n\t  vertex 1e0 0 -0\r\n      vertex 0 0.1 0\n    "
    "endloop\n  endfacet\n";

TEST(ReadMesh, AsciiStl) {
  const Mesh mesh =
      stl("\n solid facet vertex of solid\n" + ascii_facet + "endsolid facet\nsolid\tb\n" + ascii_facet + "endsolid");
  EXPECT_THAT(mesh.vertices, ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 0x1.999999999999ap-4, 0}));
  EXPECT_THAT(mesh.triangles, ElementsAre(Corners{0, 1, 2}, Corners{0, 1, 2}));
}

// ---- structure ----

TEST(ReadMesh, ObjIndicesFromEitherEnd) {
  const Mesh mesh =
      obj("# a comment\nv 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 # here too\nf -3 -2 -1\nv 0 0 1\nvn 0 0 nan\n"
          "f -4/1/1\t-3//7   -1/2 \r\nl 1 2\nusemtl what ever\nf 5 1 2\nv 5 5 5\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(Corners{0, 1, 2}, Corners{0, 1, 3}, Corners{4, 0, 1}));
}

TEST(ReadMesh, PolygonsBecomeFansAroundTheirFirstCorner) {
  const Mesh mesh = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -1 0 0\nf 2 3 4 5 1\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(Corners{1, 2, 3}, Corners{1, 3, 4}, Corners{1, 4, 0}));
}

TEST(ReadMesh, VerticesAreWelded) {
  const Mesh mesh = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\nf 4 6 5\n");
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_THAT(mesh.triangles, ElementsAre(Corners{0, 1, 2}, Corners{0, 3, 1}));
}

TEST(ReadMesh, NumbersNotAskedForMayBeAnything) {
  const Mesh mesh =
      ply("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
          "property float nx\nproperty uchar red\nproperty float green\nproperty uchar g\nproperty uchar blue\n"
          "element face 1\nproperty list uchar uint vertex_index\nproperty list uchar float uv\nend_header\n"
          "0 0 0 nan 255.0 x 1 2\n1 0 0 inf 1 1 1 1\n0 1 0 1e99 1 1 1 1\n3 0 1 2 2 a b\n");
  EXPECT_THAT(mesh.triangles, ElementsAre(Corners{0, 1, 2}));
}

// ---- what is no mesh ----

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ReadMesh, BadObj) {
  EXPECT_EQ(obj_error(""), "m: is empty");
  EXPECT_EQ(obj_error(three), "m: has no face");
  EXPECT_EQ(obj_error("v 0 nan 0\nf 1 1 1\n"), "m:1: the coordinate 'nan' is not finite");
  EXPECT_EQ(obj_error(three + "v 1e309 0 0\nf 1 2 3"), "m:4: the coordinate '1e309' is not finite");
  EXPECT_EQ(obj_error("v 0x1p0 0 0"), "m:1: '0x1p0' is no decimal number");
  EXPECT_EQ(obj_error("v 0 0 1.5f"), "m:1: '1.5f' is no decimal number");
  EXPECT_EQ(obj_error("v 0 0"), "m:1: a vertex needs three coordinates: v x y z");
  EXPECT_EQ(obj_error(three + "f 1 2"), "m:4: a face needs three vertices or more");
  EXPECT_EQ(obj_error(three + "f 1 2 4"), "m:4: vertex 4 of 3; the file has too few, is it cut off?");
  EXPECT_EQ(obj_error(three + "f 1 2 -4\nv 0 0 0"), "m:4: vertex -4: there are 3 before this line");
  EXPECT_EQ(obj_error(three + "f 0 1 2"), "m:4: vertex 0: OBJ counts from 1");
  for (const std::string corner : {"x", "3x", "1.5", "99999999999", "-", "/1", "3/x"})
    EXPECT_EQ(obj_error(three + "f 1 2 " + corner),
              "m:4: '" + corner + "' is no vertex of a face; write v, v/vt, v//vn or v/vt/vn");
  EXPECT_EQ(obj_error(three + "f 1 2 \\\n3"), "m:4: a line that goes on in the next is not read; join the two");
  EXPECT_EQ(obj_error("triangle 1 2 3"), "m:1: 'triangle' is no keyword of OBJ");
  EXPECT_EQ(obj_error(std::string("\0\n", 2)), "m:1: '\\x00' is no keyword of OBJ");
}

std::string ply_of(const std::string& header, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}
const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string three_points = "0 0 0\n1 0 0\n0 1 0\n";

TEST(ReadMesh, BadPlyHeaders) {
  EXPECT_EQ(ply_error("plyx\n"), "m:1: is no PLY: the first line has to be 'ply'");
  EXPECT_EQ(ply_error("ply"), "m: no 'end_header'; the file is cut off, or no PLY");
  EXPECT_EQ(ply_error("ply\ncomment\n"), "m:2: 'format ... 1.0' has to follow 'ply'");
  EXPECT_THAT(ply_error("ply\nformat binary 1.0\n"), HasSubstr("m:2: format 'binary'; there are ascii, "));
  EXPECT_EQ(ply_error(ply_of("property float x\n", "")), "m:3: a property in front of the first element");
  EXPECT_THAT(ply_error(ply_of("element vertex 3\nproperty half x\n", "")),
              HasSubstr("m:4: type 'half'; there are char, "));
  EXPECT_EQ(ply_error(ply_of("element vertex -1\n", "")), "m:3: '-1' is no count");
  EXPECT_EQ(ply_error(ply_of("element vertex 99999999999999999999\n", "")),
            "m:3: '99999999999999999999' is no count");
  EXPECT_EQ(ply_error(ply_of("element vertex 18446744073709551615\n", "")), "m:4: element 'vertex' has no property");
  EXPECT_EQ(ply_error(ply_of("elephant\n", "")),
            "m:3: 'elephant' is no keyword of a PLY header; remove the line, or write 'comment' in front");
  EXPECT_EQ(ply_error(ply_of("element vertex 1\nproperty float x\nproperty float y\n", "")),
            "m:6: 0 properties z of a vertex; there has to be one");
  EXPECT_EQ(ply_error(ply_of("element vertex 1\nproperty int x\nproperty float y\nproperty float z\n", "")),
            "m:7: property x of a vertex has to be a float or a double");
  EXPECT_EQ(ply_error(ply_of(vertices + vertices, "")), "m:11: 2 elements 'vertex'; there has to be one");
  EXPECT_EQ(ply_error(ply_of(vertices + "element face 1\nproperty list uchar uchar vertex_indices\n", "")),
            "m:9: property vertex_indices of a face has to be a list of int or uint");
  EXPECT_EQ(ply_error(ply_of(vertices + "element face 1\nproperty list float int vertex_indices\n", "")),
            "m:8: the count of a list has to be an integer");
  EXPECT_EQ(ply_error(ply_of(vertices + "element face 1\nproperty int corner\n", "")),
            "m:9: 0 lists vertex_indices of a face; there has to be one");
}

TEST(ReadMesh, BadAsciiPlies) {
  const std::string header = vertices + faces;
  EXPECT_EQ(ply_error(ply_of(header, three_points + "3 0 1 3\n")),
            "m: face 0 (the first is 0) has the index 3, and there are 3 vertices");
  EXPECT_EQ(ply_error(ply_of(header, three_points + "3 0 1 -1\n")), "m:13: '-1' is no index of a vertex");
  EXPECT_EQ(ply_error(ply_of(header, three_points + "2 0 1\n")),
            "m: face 0 (the first is 0) has 2 corners, and needs three");
  EXPECT_EQ(ply_error(ply_of(header, three_points + "-3 0 1 2\n")), "m:13: '-3' is no count of a list");
  EXPECT_EQ(ply_error(ply_of(header, three_points + "256 0 1 2\n")), "m:13: '256' is no count of a list");
  EXPECT_EQ(ply_error(ply_of(header, "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n")),
            "m:11: the coordinate 'nan' is not finite");
  EXPECT_EQ(ply_error(ply_of(header, "0 0 0\n1 1e39 0\n0 1 0\n3 0 1 2\n")),
            "m:11: the coordinate '1e39' is beyond a float; let the header say double");
  EXPECT_EQ(
      ply_error(ply_of(header, three_points + "3 0 1\n")),
      "m: the header promises 1 items of 'face', and the file ends in item 0; it is cut off, or the header is wrong");
  EXPECT_EQ(ply_error(ply_of(header, three_points + "3 0 1 2\n3 0 1 2\n")),
            "m:14: more numbers than the header promises; is a count too small?");
  EXPECT_EQ(ply_error(ply_of(vertices, three_points)), "m: has no triangle");
  EXPECT_EQ(ply_error(ply_of(vertices + "element face 0\nproperty list uchar int vertex_indices\n", three_points)),
            "m: has no triangle");
}

TEST(ReadMesh, HeadersThatPromiseTheWorldCostNothing) {
  const std::string bytes = binary_ply(std::endian::little, "double", hard);
  const auto replaced = [&bytes](std::string_view what, std::string_view by) {
    std::string changed = bytes;
    return changed.replace(changed.find(what), what.size(), by);
  };
  const std::string lost = ", and the file ends in item ", wrong = "; it is cut off, or the header is wrong";
  EXPECT_EQ(ply_error(replaced("vertex 3", "vertex 18446744073709551615")),
            "m: the header promises 18446744073709551615 items of 'vertex'" + lost + "3" + wrong);
  EXPECT_EQ(ply_error(replaced("face 1", "face 10000000")),
            "m: the header promises 10000000 items of 'face'" + lost + "2" + wrong);
  EXPECT_EQ(ply_error(replaced("other 2", "other 18446744073709551615")),
            "m: the header promises 18446744073709551615 items of 'other'" + lost + "2" + wrong);
  EXPECT_THAT(ply_error(replaced("face 1", "face 0")), HasSubstr("bytes are left behind what the header promises"));
  // A list of 4 * 10^9, and a negative one: of the int that says how long the list of the first vertex is.
  const std::size_t list = bytes.find("end_header\r\n", bytes.find("other")) + 12 + 1 + 24;
  std::string many = bytes;
  many.replace(list, 4, "\xff\xff\xff\x7f");
  EXPECT_EQ(ply_error(many), "m: the header promises 3 items of 'vertex'" + lost + "0" + wrong);
  many.replace(list, 4, "\xff\xff\xff\xff");
  EXPECT_EQ(ply_error(many), "m: a list of item 0 of 'vertex' has a negative count");
  EXPECT_THAT(ply_error(ply_of(vertices + "element face 1\nproperty list uint int vertex_indices\n",
                               three_points + "4000000000 0 1 2\n")),
              HasSubstr("ends in item 0"));
}

TEST(ReadMesh, EveryCutIsAnError) {
  const std::vector<std::pair<MeshFormat, std::string>> files = {
      {MeshFormat::ply, binary_ply(std::endian::big, "double", hard)},
      {MeshFormat::ply, ply_of(vertices + faces, three_points + "3 0 1 2")},
      {MeshFormat::stl, binary_stl(1, {{0, 0, 0, 1, 0, 0, 0, 1, 0}})},
      {MeshFormat::stl, "solid a\n" + ascii_facet + "endsolid"},
      {MeshFormat::obj, three + "f 1 2 3"}};
  for (const auto& [format, bytes] : files) {
    EXPECT_EQ(parse(bytes, format).triangles.size(), 1u);
    for (std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_NE(error_of([&] { parse(bytes.substr(0, size), format); }), "") << name(format) << ' ' << size;
  }
}

TEST(ReadMesh, NotFinite) {
  std::vector<double> values = hard;
  values[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ply_error(binary_ply(std::endian::little, "double", values)),
            "m: vertex 1 (the first is 0) has a coordinate that is not finite");
  // Among others, a NaN would be welded to the first that is met.
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const float bad : {inf, -inf, nan})
    EXPECT_EQ(stl_error(binary_stl(2, {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0, 1, 0, 0, 0, bad, 0}})),
              "m: facet 1 has a coordinate that is not finite");
}

TEST(ReadMesh, BadStl) {
  EXPECT_EQ(stl_error("solid"), "m: ends before 'endsolid'; the file is cut off");
  EXPECT_EQ(stl_error("nothing"), "m: is no STL: no text that begins with 'solid', and too short for a binary one");
  EXPECT_EQ(stl_error("solid\nendsolid\n"), "m: has no triangle");
  EXPECT_EQ(stl_error(binary_stl(0, {})), "m: has no triangle");
  EXPECT_EQ(stl_error(binary_stl(10000000, {{0, 0, 0, 1, 0, 0, 0, 1, 0}}, "binary")),
            "m: 10000000 facets take 500000084 bytes, the file has 134; it is cut off, or no STL");
  EXPECT_EQ(stl_error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n"), "m:4: 'x' is no decimal number");
  EXPECT_EQ(stl_error("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nendloop\n"),
            "m:6: a facet of 2 vertices; STL has triangles only");
  EXPECT_EQ(stl_error("solid\nfacet normal 0 0 1\nendfacet\n"), "m:3: a facet without 'outer loop'");
  EXPECT_EQ(stl_error("solid\nvertex 0 0 0\n"), "m:2: a vertex outside of 'outer loop' and 'endloop'");
  EXPECT_EQ(stl_error("solid\nsolid\n"), "m:2: 'solid' does not belong here");
  EXPECT_EQ(stl_error("solid\nfacets\n"), "m:2: 'facets' is no word that begins a line of an STL");
}

// ---- files ----

class MeshFiles : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& bytes) {
    const std::string path = scratch_.path() / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  static std::string error(const std::string& path) {
    return error_of([&] { read_mesh(path); });
  }
  std::string folder() const { return scratch_.path(); }

 private:
  Scratch scratch_;
};

TEST_F(MeshFiles, TheExtensionSaysWhatItIs) {
  for (const std::string name : {"a.obj", "a.OBJ", "b.x.Obj"})
    EXPECT_EQ(read_mesh(write(name, three + "f 1 2 3\n")).triangles.size(), 1u);
  for (const std::string name : {"a.off", "a", ".obj", "obj"}) {
    const std::string path = write(name, three + "f 1 2 3\n");
    EXPECT_EQ(error(path), path + ": not by its name a mesh; there are .obj, .ply, .stl");
  }
}

TEST_F(MeshFiles, WhatIsNoFileOfAMesh) {
  EXPECT_EQ(error(folder() + "/none.ply"), folder() + "/none.ply: cannot be opened: No such file or directory");
  EXPECT_EQ(error(folder()), folder() + ": is a folder; name a file in it");
  EXPECT_EQ(error("/dev/null"), "/dev/null: is no regular file; write the mesh to one first");
  EXPECT_EQ(error(write("e.stl", "")), folder() + "/e.stl: is empty");
  for (const std::string name : {"g.ply", "g.ply.gz"})
    EXPECT_EQ(error(write(name, "\x1f\x8b\x08")), folder() + "/" + name + ": is compressed (gzip); unpack it first");
}

}  // namespace
}  // namespace plumbline
