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
    if (const auto triangles = one.what.bag.triangles.size(); triangles > 1) {
      if (one.what.bag.mode != BagMode::surface)
        throw InputError(fmt::format(
            "{}: case '{}' is a {} of {} triangles, and several are judged as surfaces; remove its line 'mode'", file,
            one.what.id, name(one.what.bag.mode), triangles));
      if (one.what.expect)
        throw InputError(fmt::format("{}: case '{}' has {} triangles, and a line 'expect' is of one; remove it", file,
                                     one.what.id, triangles));
    }
  return cases;
}

}  // namespace plumbline
