#include "mesh/write_mesh.h"

#include <fmt/format.h>

#include "case/float_bits.h"
#include "case/input_error.h"
#include "case/real_text.h"

namespace plumbline {
namespace {

constexpr std::size_t part = 1 << 16;

template <class Bits>
void append_little_endian(std::string& out, Bits bits) {
  for (std::size_t k = 0; k < sizeof bits; ++k) out += static_cast<char>(bits >> (8 * k) & 0xff);
}

void write_ply(const Mesh& mesh, const std::function<void(std::string_view)>& write) {
  const bool narrow = mesh.precision == Precision::binary32;
  const std::string_view type = narrow ? "float" : "double";
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      mesh.vertices.size(), type, type, type, mesh.triangles.size());
  const auto write_full_parts = [&] {
    if (out.size() < part) return;
    write(out);
    out.clear();
  };
  for (const Vec3& v : mesh.vertices) {
    for (const double x : {v.x, v.y, v.z})
      narrow ? append_little_endian(out, to_bits(static_cast<float>(x))) : append_little_endian(out, to_bits(x));
    write_full_parts();
  }
  for (const Corners& corners : mesh.triangles) {
    out += '\3';
    for (const std::uint32_t corner : corners) append_little_endian(out, corner);
    write_full_parts();
  }
  write(out);
}

void write_obj(const Mesh& mesh, const std::function<void(std::string_view)>& write) {
  std::string out;
  const auto write_full_parts = [&] {
    if (out.size() < part) return;
    write(out);
    out.clear();
  };
  for (const Vec3& v : mesh.vertices) {
    out += 'v';
    for (const double x : {v.x, v.y, v.z}) append_shortest_decimal(out += ' ', x);
    out += '\n';
    write_full_parts();
  }
  for (const auto [a, b, c] : mesh.triangles) {
    fmt::format_to(std::back_inserter(out), "f {} {} {}\n", std::uint64_t{a} + 1, std::uint64_t{b} + 1,
                   std::uint64_t{c} + 1);
    write_full_parts();
  }
  write(out);
}

}  // namespace

void write_mesh(const Mesh& mesh, MeshFormat format, const std::function<void(std::string_view)>& write) {
  switch (format) {
    case MeshFormat::ply:
      return write_ply(mesh, write);
    case MeshFormat::obj:
      return write_obj(mesh, write);
    case MeshFormat::stl:
      throw InputError("an STL holds floats only and is not written; name the file .ply or .obj");
  }
}

}  // namespace plumbline
