#include "mesh/read_mesh.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>

#include "case/enum_names.h"
#include "case/finite.h"
#include "case/input_error.h"
#include "case/printable.h"
#include "mesh/polygon_soup.h"
#include "mesh/vetted.h"
#include "mesh/weld.h"

namespace plumbline {
namespace {

// The first bytes of what has to be unpacked first.
struct Packed {
  std::string_view magic, what;
};
constexpr std::array<Packed, 5> packed = {{{"\x1f\x8b", "gzip"},
                                           {"BZh", "bzip2"},
                                           {"\xfd"
                                            "7zXZ",
                                            "xz"},
                                           {"\x28\xb5\x2f\xfd", "zstd"},
                                           {"PK\x03\x04", "zip"}}};

std::string bytes_of(const std::string& path) {
  const auto fail = [&path](std::string_view what) { throw InputError(fmt::format("{}: {}", path, what)); };
  struct Descriptor {
    int number;
    ~Descriptor() {
      if (number >= 0) close(number);
    }
  };
  const Descriptor file = {open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};  // a pipe is not waited for
  struct stat status;
  if (file.number < 0 || fstat(file.number, &status) != 0)
    fail(fmt::format("cannot be opened: {}", std::strerror(errno)));
  if (S_ISDIR(status.st_mode)) fail("is a folder; name a file in it");
  if (!S_ISREG(status.st_mode)) fail("is no regular file; write the mesh to one first");

  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t got = read(file.number, bytes.data() + at, bytes.size() - at);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(fmt::format("cannot be read: {}", std::strerror(errno)));
    if (got == 0) bytes.resize(at);
    at += static_cast<std::size_t>(got);
  }
  return bytes;
}

void refuse_packed(std::string_view bytes, const std::string& name) {
  for (const auto& [magic, what] : packed)
    if (bytes.starts_with(magic))
      throw InputError(fmt::format("{}: is compressed ({}); unpack it first", name, what));
}

std::string vetted(std::string bytes, MeshFormat format, const std::string& name) {
  switch (format) {
    case MeshFormat::obj:
      return vetted_obj(std::move(bytes), name);
    case MeshFormat::ply:
      return vetted_ply(std::move(bytes), name);
    case MeshFormat::stl:
      break;
  }
  return vetted_stl(std::move(bytes), name);
}

Mesh mesh_of(PolygonSoup soup, const std::string& name) {
  constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
  if (soup.points.size() >= most) throw InputError(fmt::format("{}: more than 2^32 vertices", name));
  Mesh mesh;
  mesh.vertices = std::move(soup.points);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (!is_finite(mesh.vertices[i]))
      throw InputError(fmt::format("{}: vertex {} (the first is 0) has a coordinate that is not finite", name, i));
  mesh.precision = precision_of(mesh.vertices);
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const std::vector<std::uint32_t>& corners = soup.polygons[i];
    if (corners.size() < 3)
      throw InputError(
          fmt::format("{}: face {} (the first is 0) has {} corners, and needs three", name, i, corners.size()));
    for (const std::uint32_t corner : corners)
      if (corner >= mesh.vertices.size())
        throw InputError(fmt::format("{}: face {} (the first is 0) has the index {}, and there are {} vertices", name,
                                     i, corner, mesh.vertices.size()));
    for (std::size_t k = 2; k < corners.size(); ++k)
      mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }
  if (mesh.triangles.empty()) throw InputError(fmt::format("{}: has no triangle", name));
  if (mesh.triangles.size() >= most) throw InputError(fmt::format("{}: more than 2^32 triangles", name));
  return mesh;
}

}  // namespace

MeshFormat mesh_format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  const auto format =
      extension.empty() ? std::nullopt : from_name<MeshFormat>(mesh_format_names, extension.substr(1));
  if (!format)
    throw InputError(
        fmt::format("{}: not by its name a mesh; there are .{}", path, fmt::join(mesh_format_names, ", .")));
  return *format;
}

Mesh parse_mesh(std::string bytes, MeshFormat format, const std::string& name) {
  if (bytes.empty()) throw InputError(fmt::format("{}: is empty", name));
  std::optional<PolygonSoup> soup = read_polygon_soup(vetted(std::move(bytes), format, name), format);
  if (!soup)  // what was vetted can be read: a fuzz target holds us to it
    throw InputError(
        fmt::format("{}: the reader of {} refuses it; please report the file", name, plumbline::name(format)));
  return welded(mesh_of(std::move(*soup), name));
}

Mesh read_mesh(const std::string& path) {
  const std::string name = printable(path);
  std::string bytes = bytes_of(path);
  refuse_packed(bytes, name);
  const MeshFormat format = mesh_format_of(path);
  return parse_mesh(std::move(bytes), format, name);
}

}  // namespace plumbline
