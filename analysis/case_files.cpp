#include "analysis/case_files.h"

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

}  // namespace plumbline
