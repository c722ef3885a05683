#include "analysis/sweep_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/tracers.h"

namespace plumbline {
namespace {

using testing::HasSubstr;
using testing::Not;

SweepResult result_of(std::vector<double> standoffs) {
  SweepResult result;
  result.done = {0, 512};
  result.triangles = 336;
  for (const double h : standoffs) {
    result.rows.push_back({&find_tracer("exact"), {0, 0.25, 0}, h, TargetKind::vertex_edge, {}, {}});
    result.rows.back().tally = {2016, 1710 + static_cast<std::uint64_t>(h), 1890, 192, 12, 4, 9, 5, 1, 2};
    result.rows.push_back({&find_tracer("exact"), {0, 0.25, 0}, h, TargetKind::tolerance, 0.00001, {}});
    result.rows.back().tally = {6048, 5528, 5760, 352, 120, 9, 110, 6, 3, 4};
  }
  return result;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

TEST(SweepTable, JsonHasTheKeysOfTheContract) {
  const auto lines = split(to_json_lines(result_of({5})), '\n');
  ASSERT_EQ(lines.size(), 2);
  const auto expected = nlohmann::json::parse(R"({
      "tracer": "exact", "offset": [0.0, 0.25, 0.0], "standoff": 5.0, "target": "vertex_edge", "tolerance": null,
      "attempts": 2016, "successes": 1715, "exact_successes": 1890, "harness_errors": 126, "false_misses": 192,
      "false_hits": 12, "lucky": 13, "unspecified": 1, "faults": 2})");
  EXPECT_EQ(nlohmann::json::parse(lines[0]), expected);
  EXPECT_EQ(nlohmann::json::parse(lines[1])["tolerance"], 0x1.4f8b588e368f1p-17);
  EXPECT_EQ(nlohmann::json::parse(lines[1])["target"], "tolerance");
}

TEST(SweepTable, CsvHoldsTheSameAsJsonAndMore) {
  const SweepResult result = result_of({0.25, 10000});
  const auto json = split(to_json_lines(result), '\n'), csv = split(to_csv(result), '\n');
  ASSERT_EQ(csv.size(), json.size() + 1);
  const auto columns = split(csv[0], ',');
  for (std::size_t i = 0; i < json.size(); ++i) {
    auto object = nlohmann::json::parse(json[i]);
    object["offset_x"] = object["offset"][0];
    object["offset_y"] = object["offset"][1];
    object["offset_z"] = object["offset"][2];
    object.erase("offset");
    const Tally& tally = result.rows[i].tally;
    object["lucky_misses"] = tally.lucky_misses;
    object["lucky_hits"] = tally.lucky_hits;
    object["unlucky_harness_errors"] = tally.unlucky_harness_errors;
    const auto cells = split(csv[i + 1], ',');
    ASSERT_EQ(cells.size(), columns.size());
    ASSERT_EQ(object.size(), columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto& value = object.at(columns[k]);
      if (value.is_null())
        EXPECT_EQ(cells[k], "");
      else if (value.is_string())
        EXPECT_EQ(cells[k], value.get<std::string>());
      else
        EXPECT_EQ(std::stod(cells[k]), value.get<double>()) << columns[k];
    }
  }
}

TEST(SweepTable, ShowsEachRowOfOneStandoff) {
  const std::string text = to_terminal(result_of({5}));
  EXPECT_THAT(text, HasSubstr("336 triangles among the ordered triples [0, 512); standoff h = 5\n"));
  EXPECT_THAT(text, HasSubstr("exact   vertex/edge          2016       1715  85.07   1890      126         192         "
                              "12     13            1      2\n"));
  EXPECT_THAT(text, HasSubstr("exact   tolerance 1e-05      6048"));
  EXPECT_THAT(text, Not(HasSubstr(" \n")));
}

TEST(SweepTable, ShowsTheRangeOverStandoffs) {
  const std::string text = to_markdown(result_of({0.25, 20, 5}));
  EXPECT_THAT(text, HasSubstr("standoff h = 0.25 to 20\n"));
  EXPECT_THAT(text,
              HasSubstr("| exact  | 0 0.25 0 | vertex/edge     |     2016 |  1710 | 84.82 | 0.25 | 1730 | 85.81 |"));
  EXPECT_THAT(text, HasSubstr("|   20 |        1890 |       1890 |\n"));
  EXPECT_THAT(text, HasSubstr("| ------ | -------- | --------------- | -------: | ----: |"));
}

}  // namespace
}  // namespace plumbline
