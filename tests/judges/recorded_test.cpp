// The oracle against the column `exact` of the recordings, which Python's fractions filled.
#include "tests/recorded_rows.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "oracle/classify.h"
#include "oracle/explain.h"

namespace plumbline {
namespace {

std::string_view recorded_name(HitClass c) {
  switch (c) {
    case HitClass::interior: return "int";
    case HitClass::edge: return "edge";
    case HitClass::vertex: return "vert";
    case HitClass::exterior: return "out";
    case HitClass::parallel:
    case HitClass::coplanar:
    case HitClass::degenerate: return "par";
    case HitClass::invalid: break;
  }
  return "invalid";
}

std::size_t compare_all(const std::filesystem::path& directory) {
  std::size_t count = 0;
  for (const auto& file : recorded_files(directory))
    for (const RecordedRow& row : read_recorded_rows(file)) {
      EXPECT_EQ(recorded_name(classify(row.triangle, row.ray).hit_class), row.exact)
          << file.filename() << " row " << row.id << '\n'
          << explain(row.triangle, row.ray);
      ++count;
    }
  return count;
}

TEST(RecordedTruth, TheOracleAgreesOnTheSample) { EXPECT_EQ(compare_all(recorded_sample()), 1913u); }

TEST(RecordedTruth, TheOracleAgreesOnFullRecordings) {
  const auto directory = full_recordings();
  if (!directory) GTEST_SKIP() << "set PLUMBLINE_RECORDED to a directory of full recordings";
  const std::size_t count = compare_all(*directory);
  EXPECT_GT(count, 0u);
  std::printf("%zu recorded rows compared\n", count);
}

}  // namespace
}  // namespace plumbline
