// Reads recordings of a real BRL-CAD at bags of several faces (corpus/recorded/README.md): lines of fields with commas
// between, numbers as hexfloats, of which the first field says what it is.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "case/answer.h"
#include "case/case.h"

namespace plumbline {

struct RecordedShot {
  Ray ray;
  std::vector<Passage> passages;
};
struct RecordedBag {
  std::string mesh;
  Bag bag;
  std::vector<RecordedShot> shots;
};

inline std::filesystem::path recorded_bags_file() {
  return PLUMBLINE_SOURCE_DIR "/corpus/recorded/bags/brlcad-7.24.2-bags.csv";
}

/// Throws std::runtime_error that names file and line.
inline std::vector<RecordedBag> read_recorded_bags(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot open " + file.string());
  std::vector<RecordedBag> bags;
  std::string mesh;
  std::vector<Triangle> triangles;
  std::size_t line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> field;
    std::istringstream split(line);
    for (std::string f; std::getline(split, f, ',');) field.push_back(f);
    const auto require = [&](bool condition, const std::string& what) {
      if (!condition) throw std::runtime_error(file.string() + ":" + std::to_string(line_number) + ": " + what);
    };
    const auto number = [&](std::size_t i) {
      require(i < field.size(), "a field is missing");
      char* end = nullptr;
      const double value = std::strtod(field[i].c_str(), &end);
      require(!field[i].empty() && !*end, "expected a number, found '" + field[i] + "'");
      return value;
    };
    const auto vector = [&](std::size_t i) { return Vec3{number(i), number(i + 1), number(i + 2)}; };
    const auto one_of = [&](std::size_t i, const auto& names) {
      require(i < field.size(), "a field is missing");
      for (std::size_t k = 0; k < names.size(); ++k)
        if (field[i] == names[k]) return k;
      require(false, "an unknown name, '" + field[i] + "'");
      return names.size();
    };
    if (field[0] == "mesh") {
      require(field.size() == 2, "expected a name");
      mesh = field[1];
      triangles.clear();
    } else if (field[0] == "triangle") {
      require(field.size() == 10, "expected 9 numbers");
      triangles.push_back({vector(1), vector(4), vector(7)});
    } else if (field[0] == "bag") {
      require(field.size() == 6, "expected 5 fields");
      bags.push_back({.mesh = mesh,
                      .bag = {.triangles = triangles,
                              .mode = static_cast<BagMode>(one_of(1, bag_mode_names)),
                              .thickness = number(3),
                              .position = static_cast<PlatePosition>(one_of(4, plate_position_names)),
                              .cosine = one_of(5, std::vector<std::string>{"false", "true"}) == 1,
                              .orientation = static_cast<Orientation>(one_of(2, orientation_names))},
                      .shots = {}});
    } else if (field[0] == "ray") {
      require(!bags.empty() && field.size() >= 7 && (field.size() - 7) % 4 == 0, "expected 6 numbers, and 4 a passage");
      RecordedShot shot{.ray = {.origin = vector(1), .direction = vector(4)}, .passages = {}};
      for (std::size_t i = 7; i < field.size(); i += 4)
        shot.passages.push_back({number(i), number(i + 1), static_cast<std::uint32_t>(number(i + 2)),
                                 static_cast<std::uint32_t>(number(i + 3))});
      bags.back().shots.push_back(std::move(shot));
    } else {
      require(false, "expected mesh, triangle, bag or ray");
    }
  }
  return bags;
}

}  // namespace plumbline
