#include "analysis/case_forms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "case/case_lines.h"
#include "case/case_text.h"
#include "case/input_error.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t too_long = 1 << 10;  // for any input: of a longer file, no more is read

std::vector<std::byte> read_start(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  std::vector<std::byte> bytes(too_long);
  file.read(reinterpret_cast<char*>(bytes.data()), too_long);
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

Case read_bytes(const std::string& path, const BytesReading& reading) {
  const std::vector<std::byte> bytes = read_start(path);
  std::string sizes;
  for (const Space space : {Space::ray, Space::target})
    for (const Precision precision : {Precision::binary32, Precision::binary64}) {
      if (space != reading.space.value_or(space) || precision != reading.precision.value_or(precision)) continue;
      const std::size_t size = input_size(space, precision);
      if (bytes.size() == size) {
        Case read = to_case(decode(bytes, space, precision, reading.domain));
        read.id = fs::path(path).filename().string();
        return read;
      }
      sizes += fmt::format("{}{} ({} space, {})", sizes.empty() ? "" : ", ", size, name(space), name(precision));
    }
  throw InputError(fmt::format("{}: {} bytes{}, a fuzzer's input has {}; name other files .case or .ndjson", path,
                               bytes.size(), bytes.size() == too_long ? " or more" : "", sizes));
}

}  // namespace

CaseForm form_of(const std::string& path) {
  const fs::path extension = fs::path(path).extension();
  if (extension == ".case") return CaseForm::text;
  return path == "-" || extension == ".ndjson" || extension == ".jsonl" ? CaseForm::ndjson : CaseForm::bytes;
}

std::vector<std::string> files_of(const std::string& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (!entry.is_directory()) files.push_back(entry.path().string());
  if (files.empty()) throw InputError(fmt::format("{}: no file in this folder", path));
  std::ranges::sort(files);
  return files;
}

void read_any_cases(const std::string& path, const BytesReading& reading,
                    const std::function<void(const Case&)>& take) {
  switch (form_of(path)) {
    case CaseForm::text:
      for (const Case& read : read_cases(path)) take(read);
      break;
    case CaseForm::ndjson: {
      CaseLines lines(path);
      for (CaseLine line; lines.next(line);) take(line.asked);
      break;
    }
    case CaseForm::bytes:
      take(read_bytes(path, reading));
      break;
  }
}

}  // namespace plumbline
