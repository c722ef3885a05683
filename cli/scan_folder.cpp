#include "cli/scan_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>

#include "case/fingerprint.h"
#include "case/float_bits.h"
#include "case/folder.h"
#include "case/input_error.h"
#include "cli/output.h"

namespace plumbline {
namespace {

std::uint64_t fingerprint(const Mesh& mesh) {
  Fingerprint print;
  for (const Vec3& v : mesh.vertices)
    for (const double x : {v.x, v.y, v.z}) print.add(to_bits(x));
  for (const Corners& corners : mesh.triangles)
    for (const std::uint32_t corner : corners) print.add(corner);
  return print.value();
}

// A library or program of one's own changes under its name.
std::string identity(const Tracer& tracer) {
  const TracerInfo& info = tracer.info();
  std::ifstream file(info.package, std::ios::binary);
  if (info.package.empty() || !file) return info.name;
  Fingerprint print;
  for (std::istreambuf_iterator<char> c(file), end; c != end; ++c) print.add(static_cast<unsigned char>(*c));
  return fmt::format("{} {:016x}", info.name, print.value());
}

}  // namespace

ScanFolder::ScanFolder(const std::string& path, const ScanPlan& plan, std::uint64_t seed) : path_(path) {
  if (path_.empty()) return;
  plan_line_ = fmt::format("plan {:016x} seed {}", fingerprint(*plan.mesh), seed);
  for (const ScanSet& set : plan.sets) plan_line_ += fmt::format(" | {} {}", set.name, set.size);
  for (const Tracer* tracer : plan.tracers) plan_line_ += " | " + identity(*tracer);
  make_folder(path_ / "findings");
  lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(lock_);
    throw InputError(fmt::format("{}: another scan is at work in it; wait for its end, or name a new folder", path));
  }
}

ScanFolder::~ScanFolder() {
  if (lock_ >= 0) close(lock_);
}

ScanState ScanFolder::begin(const ScanPlan& plan) const {
  std::ifstream file(path_ / "scan.state");
  if (path_.empty() || !file) return blank(plan);
  std::string first, second;
  std::getline(file, first);
  std::getline(file, second);
  if (first != plan_line_)
    throw InputError(
        fmt::format("{}: holds a scan of another mesh, seed, choice of rays or tracers (a library that was rebuilt is "
                    "another); name a new "
                    "folder, or give the same again to take it up",
                    path_.string()));
  const auto state = from_line(second, plan);
  if (!state)
    throw InputError(
        fmt::format("{}: is damaged; remove it, and the scan begins anew", (path_ / "scan.state").string()));
  return *state;
}

std::vector<std::string> ScanFolder::words(const std::string& tracer) const {
  std::vector<std::string> list;
  std::error_code none;  // of a tracer that did nothing wrong there is no folder
  for (const auto& entry : std::filesystem::directory_iterator(path_ / "findings" / tracer, none)) {
    const std::filesystem::path file = entry.path().filename();
    if (file.extension() == ".case" && file.stem().extension() != ".min") list.push_back(file.stem().string());
  }
  std::ranges::sort(list);
  return list;
}

void ScanFolder::keep(const ScanState& state) const { write("scan.state", plan_line_ + "\n" + to_line(state) + "\n"); }

void ScanFolder::write(const std::filesystem::path& name, const std::string& text) const {
  if (path_.empty()) return;
  make_folder((path_ / name).parent_path());
  Output output((path_ / name).string());
  output.write(text);
  output.finish();
}

}  // namespace plumbline
