// Reads recordings of a real BRL-CAD (corpus/recorded/README.md): CSV with comment lines, numbers as hexfloats.
#pragma once
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"

namespace plumbline {

struct RecordedRow {
  std::string id;
  std::string kind;  ///< the column `class`: how the ray was aimed
  Triangle triangle;
  Ray ray;
  bool hit = false;
  double in = 0, out = 0;   ///< of a hit
  bool kernel_hit = false;  ///< of the triangle test alone
  bool prepped = false;     ///< false: BRL-CAD dropped the face, so it can only miss
  std::string exact;        ///< "int", "edge", "vert", "out" or "par": of the infinite line and the closed triangle
};

/// The object that every recorded ray was shot at.
inline Bag recorded_bag(const Triangle& triangle) {
  return {.triangles = {triangle}, .mode = BagMode::plate, .thickness = 0.1};
}

/// Where the repository keeps its sample.
inline std::filesystem::path recorded_sample() { return PLUMBLINE_SOURCE_DIR "/corpus/recorded"; }

/// A directory with full recordings, if the environment names one.
inline std::optional<std::filesystem::path> full_recordings() {
  const char* directory = std::getenv("PLUMBLINE_RECORDED");
  if (!directory || !*directory) return std::nullopt;
  return directory;
}

/// The CSV files of a directory, by name.
inline std::vector<std::filesystem::path> recorded_files(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// Throws std::runtime_error that names file and line.
inline std::vector<RecordedRow> read_recorded_rows(const std::filesystem::path& file) {
  constexpr std::string_view columns =
      "id,tri,ax,ay,az,bx,by,bz,cx,cy,cz,ox,oy,oz,dx,dy,dz,class,tolerance,expected,hit,in,out,kernel_hit,prepped,"
      "exact";
  constexpr std::size_t column_count = 26;
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot open " + file.string());

  std::vector<RecordedRow> rows;
  bool seen_columns = false;
  std::size_t line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    const auto fail = [&](const std::string& what) -> std::runtime_error {
      return std::runtime_error(file.string() + ":" + std::to_string(line_number) + ": " + what);
    };
    if (line.empty() || line.front() == '#') continue;
    if (!seen_columns) {
      if (line != columns) throw fail("expected the column names " + std::string(columns));
      seen_columns = true;
      continue;
    }
    std::array<std::string_view, column_count> field;
    std::string_view rest = line;
    for (std::size_t i = 0; i < column_count; ++i) {
      const std::size_t comma = rest.find(',');
      if ((comma == std::string_view::npos) != (i + 1 == column_count))
        throw fail("expected " + std::to_string(column_count) + " fields");
      field[i] = rest.substr(0, comma);
      if (i + 1 < column_count) rest.remove_prefix(comma + 1);
    }
    const auto number = [&](std::size_t i) {
      const std::string text(field[i]);
      char* end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (text.empty() || *end) throw fail("expected a number, found '" + text + "'");
      return value;
    };
    const auto vector = [&](std::size_t i) { return Vec3{number(i), number(i + 1), number(i + 2)}; };
    const auto flag = [&](std::size_t i) {
      if (field[i] != "0" && field[i] != "1") throw fail("expected 0 or 1, found '" + std::string(field[i]) + "'");
      return field[i] == "1";
    };
    RecordedRow row{.id = std::string(field[0]),
                    .kind = std::string(field[17]),
                    .triangle = {vector(2), vector(5), vector(8)},
                    .ray = {.origin = vector(11), .direction = vector(14)},
                    .hit = flag(20),
                    .kernel_hit = flag(23),
                    .prepped = flag(24),
                    .exact = std::string(field[25])};
    if (row.hit) {
      row.in = number(21);
      row.out = number(22);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace plumbline
