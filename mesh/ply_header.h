// The header of a PLY: its elements and their properties, in the file's order. Private to mesh.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline {

enum class PlyFormat : unsigned char { ascii, binary_little_endian, binary_big_endian };
inline constexpr std::array<std::string_view, 3> ply_format_names = {"ascii", "binary_little_endian",
                                                                     "binary_big_endian"};
constexpr std::string_view name(PlyFormat f) { return ply_format_names[static_cast<unsigned>(f)]; }

enum class PlyType : unsigned char { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
inline constexpr std::array<std::string_view, 8> ply_type_names = {"char", "uchar", "short", "ushort",
                                                                   "int",  "uint",  "float", "double"};
constexpr std::string_view name(PlyType t) { return ply_type_names[static_cast<unsigned>(t)]; }
inline constexpr std::array<std::size_t, 8> ply_type_sizes = {1, 1, 2, 2, 4, 4, 4, 8};
constexpr std::size_t size_of(PlyType t) { return ply_type_sizes[static_cast<unsigned>(t)]; }
constexpr bool is_integer(PlyType t) { return t < PlyType::float32; }

/// What a property is to a mesh.
enum class PlyRole : unsigned char { none, coordinate, corners };

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count;  ///< the type of a list's count, which is an integer
  PlyRole role = PlyRole::none;
};

struct PlyElement {
  std::string name;
  std::uint64_t items;
  std::vector<PlyProperty> properties;  ///< one or more
};

struct PlyHeader {
  PlyFormat format;
  std::vector<PlyElement> elements;
  std::size_t size;  ///< in bytes, the end of line behind end_header included
  std::size_t lines;
};

/// There is one element of vertices, with coordinates x, y, z of float or double, and at most one of faces, which has
/// one list of corners, of int or uint. Throws InputError with the line.
PlyHeader read_ply_header(std::string_view bytes, const std::string& file);

/// The same header in as few words as CGAL's reader needs: what has no role has no name.
std::string plain_header(const PlyHeader& header);

}  // namespace plumbline
