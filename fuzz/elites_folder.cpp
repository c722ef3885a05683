#include "fuzz/elites_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdio>
#include <memory>
#include <optional>

#include "case/folder.h"
#include "case/input_error.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

std::string file_name(const Elite& elite) {
  // Without the fingerprint, elites of equal scores would have one name.
  return fmt::format("{:08x}-{:016x}-{:016x}", elite.cell, std::bit_cast<std::uint64_t>(elite.score), fingerprint(elite));
}

struct Hint {
  Cell cell;
  double score;
};

std::optional<Hint> hint_of(const std::string& name) {
  if (name.size() != 42 || name[8] != '-' || name[25] != '-') return std::nullopt;
  Cell cell = 0;
  std::uint64_t bits = 0;
  const char* text = name.data();
  if (std::from_chars(text, text + 8, cell, 16).ptr != text + 8) return std::nullopt;
  if (std::from_chars(text + 9, text + 25, bits, 16).ptr != text + 25) return std::nullopt;
  return Hint{cell, std::bit_cast<double>(bits)};
}

using File = std::unique_ptr<std::FILE, decltype([](std::FILE* f) { std::fclose(f); })>;

bool write_file(const fs::path& path, std::span<const std::byte> bytes) {
  File file(std::fopen(path.c_str(), "wb"));
  if (!file || std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) return false;
  return std::fclose(file.release()) == 0;
}

// Empty where it can't be read, or isn't of that size.
std::vector<std::byte> read_file(const fs::path& path, std::size_t size) {
  std::vector<std::byte> bytes(size + 1);
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file || std::fread(bytes.data(), 1, size + 1, file.get()) != size) return {};
  bytes.resize(size);
  return bytes;
}

}  // namespace

ElitesFolder::ElitesFolder(fs::path path) : path_(std::move(path)) {
  make_folder(path_);
}

void ElitesFolder::note(const Elites& elites) {
  for (const auto at : elites.changed()) dirty_.insert(elites.all()[at].cell);
}

std::size_t ElitesFolder::flush(const Elites& elites) {
  const fs::path part = path_ / fmt::format(".part.{}", getpid());
  std::erase_if(dirty_, [&](Cell cell) {
    const Elite& elite = *elites.at(cell);
    std::string name = file_name(elite);
    std::vector<std::byte> bytes(input_size(elite.input.space, elite.input.precision));
    encode(elite.input, bytes);
    std::error_code error;
    if (!write_file(part, bytes)) error = std::make_error_code(std::errc::io_error);
    if (!error) fs::rename(part, path_ / name, error);
    if (error) {
      fs::remove(part, error);
      return false;
    }
    for (const std::string& worse : files_[cell])
      if (worse != name) fs::remove(path_ / worse, error);
    seen_.insert(name);
    files_[cell] = {std::move(name)};
    return true;
  });
  return dirty_.size();
}

void ElitesFolder::scan(const Elites& elites, const FuzzInput& like, Domain domain,
                        const std::function<void(const FuzzInput&)>& take) {
  const bool first = seen_.empty();  // names may be of a tracer that has changed since
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path_, error)) {
    std::string name = entry.path().filename().string();
    if (!name.starts_with('.') && !seen_.contains(name)) names.push_back(std::move(name));
  }
  std::ranges::sort(names);  // the order of a folder is nobody's
  for (std::string& name : names) {
    const auto hint = hint_of(name);
    const Elite* const there = hint ? elites.at(hint->cell) : nullptr;
    if (first || !there || !(hint->score < there->score)) {
      const auto bytes = read_file(path_ / name, input_size(like.space, like.precision));
      if (!bytes.empty()) take(decode(bytes, like.space, like.precision, domain));
    }
    if (hint) files_[hint->cell].push_back(name);
    seen_.insert(std::move(name));
  }
}

}  // namespace plumbline
