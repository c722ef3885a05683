#include "case/case_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "case/input_error.h"

namespace plumbline {

namespace fs = std::filesystem;

std::vector<std::string> case_files(const std::string& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (entry.path().extension() == ".case" && !entry.is_directory()) files.push_back(entry.path().string());
  if (files.empty()) throw InputError(fmt::format("{}: no *.case file in this folder", path));
  std::ranges::sort(files);
  return files;
}

std::vector<PlacedCase> cases_to_judge(const std::string& file) {
  auto cases = read_placed_cases(file);
  if (cases.empty()) throw InputError(fmt::format("{}: no case in this file", file));
  for (const PlacedCase& one : cases)
    if (const auto triangles = one.what.bag.triangles.size(); triangles != 1)
      throw InputError(
          fmt::format("{}: case '{}' has {} triangles; a verdict is on one", file, one.what.id, triangles));
  return cases;
}

}  // namespace plumbline
