// Meshes from files: OBJ, PLY (ascii, binary little and big endian), STL (ascii, binary).
//
// No bit is lost: a binary float or double arrives as it is, a decimal becomes the nearest binary64 number, or the
// nearest binary32 number where a PLY says `float`. Polygons of more than three corners become fans around their
// first corner. Vertices with equal coordinates are one vertex afterwards, and -0 equals 0 (weld.h). Units are the
// file's. Throws InputError, which names file, place and fix, for everything that is no mesh: not there, a folder,
// compressed, cut off, without triangles, a coordinate that is not finite, an index of no vertex. Memory is bounded
// by a multiple of the file's size, whatever its header promises.
//
// The values are read by CGAL's readers of polygon soups; what these must not be given is seen to before (vetted.h).
#pragma once
#include <array>
#include <string>
#include <string_view>

#include "mesh/mesh.h"

namespace plumbline {

enum class MeshFormat : unsigned char { obj, ply, stl };
inline constexpr std::array<std::string_view, 3> mesh_format_names = {"obj", "ply", "stl"};
constexpr std::string_view name(MeshFormat f) { return mesh_format_names[static_cast<unsigned>(f)]; }

/// By the file's extension, in any case. Throws InputError if it is none of the three.
MeshFormat mesh_format_of(const std::string& path);

Mesh read_mesh(const std::string& path);

/// The same of a file's bytes; `name` is what messages call it.
Mesh parse_mesh(std::string bytes, MeshFormat format, const std::string& name);

}  // namespace plumbline
