// Meshes into files, so that no bit is lost: a binary little-endian PLY, of floats where the mesh is of binary32
// numbers and of doubles elsewhere, or an OBJ of shortest decimals that read back as the same numbers. The same mesh
// gives the same bytes on every machine. An STL would lose what is no float, and is not written.
#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "mesh/mesh.h"
#include "mesh/read_mesh.h"

namespace plumbline {

/// Hands the file to `write` a part at a time. Throws InputError for an STL.
void write_mesh(const Mesh& mesh, MeshFormat format, const std::function<void(std::string_view)>& write);

}  // namespace plumbline
