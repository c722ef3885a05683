// The bytes of a mesh file, read as each of the formats.
#include <cstddef>
#include <cstdint>
#include <string>

#include "case/finite.h"
#include "fuzz/readers/promise.h"
#include "mesh/read_mesh.h"
#include "mesh/write_mesh.h"

namespace plumbline {
namespace {

void check_invariant(const Mesh& mesh) {
  if (mesh.triangles.empty()) broken("a mesh without triangles");
  for (const Vec3& v : mesh.vertices)
    if (!is_finite(v)) broken("a coordinate that is not finite");
  for (const Corners& corners : mesh.triangles)
    for (const std::uint32_t corner : corners)
      if (corner >= mesh.vertices.size()) broken("an index of no vertex");
  if (mesh.precision != precision_of(mesh.vertices)) broken("another precision than the vertices'");
}

void check_written(const Mesh& mesh, MeshFormat format) {
  std::string bytes;
  write_mesh(mesh, format, [&bytes](std::string_view part) { bytes += part; });
  if (reread([&] { return parse_mesh(bytes, format, "written"); }) != mesh)
    broken("a mesh that reads back as another");
}

void run(const std::string& bytes, MeshFormat format) {
  Mesh mesh;
  if (refused([&] { mesh = parse_mesh(bytes, format, "mesh"); })) return;
  check_invariant(mesh);
  check_written(mesh, MeshFormat::ply);
  check_written(mesh, MeshFormat::obj);
}

}  // namespace
}  // namespace plumbline

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  for (const auto format : {plumbline::MeshFormat::obj, plumbline::MeshFormat::ply, plumbline::MeshFormat::stl})
    plumbline::run(bytes, format);
  return 0;
}
