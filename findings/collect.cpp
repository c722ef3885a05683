#include "findings/collect.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "case/case_lines.h"
#include "case/case_text.h"
#include "case/input_error.h"
#include "case/input_file.h"
#include "findings/json_text.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Take = std::function<void(const Case&, const std::string&)>;

// What a line of findings.ndjson says of the finding, beside the case.
constexpr std::array<const char*, 8> not_of_the_case = {"signature",    "kind",          "element",   "rejection",
                                                        "conditioning", "severity_ulps", "execution", "seed"};

void take_lines(const std::string& path, const Take& take) {
  InputFile file(path);
  CaseObjects cases("case");
  for (std::string_view line; file.next_line(line);) {
    try {
      Json json = Json::parse(line);
      const std::string tracer = json.at("tracer");
      json.erase("tracer");
      for (const char* key : not_of_the_case) json.erase(key);
      take(cases.read(text_of(std::move(json))), tracer);
    } catch (const Json::exception& error) {
      throw InputError(fmt::format("{}:{}: no finding of a campaign: {}", path, file.line_number(), error.what()));
    }
  }
}

void take_cases(const std::string& path, const Take& take) {
  for (const Case& what : read_cases(path))
    for (const Known& known : what.known) take(what, known.tracer);
}

bool is_lines(const fs::path& path) { return path.extension() == ".ndjson"; }

std::vector<fs::path> files_in(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (!entry.is_directory() &&
        (entry.path().extension() == ".case" || entry.path().filename() == "findings.ndjson"))
      files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

void for_each_known(const std::string& path, const Take& take) {
  const std::vector<fs::path> files = files_in(path);
  if (files.empty()) throw InputError(fmt::format("{}: no *.case and no findings.ndjson in this folder", path));
  for (const fs::path& file : files) {
    if (is_lines(file))
      take_lines(file.string(), take);
    else
      take_cases(file.string(), take);
  }
}

}  // namespace plumbline
