// BRL-CAD's rules against answers recorded from the real thing, bit for bit.
#include <gtest/gtest.h>

#include <set>

#include "case/float_bits.h"
#include "tests/float_tracer/shoot.h"
#include "tests/recorded_rows.h"

namespace plumbline {
namespace {

bool same_bits(double x, double y) { return to_bits(x) == to_bits(y); }

testing::AssertionResult equals_recording(const Answer& answer, const RecordedRow& row) {
  const bool hit = answer.outcome == Outcome::hit;
  if (answer.outcome != Outcome::fault && hit == row.hit &&
      (!hit || (answer.has_segment && same_bits(answer.in, row.in) && same_bits(answer.out, row.out))))
    return testing::AssertionSuccess();
  char text[256];
  std::snprintf(text, sizeof text, "row %s (%s): recorded %s in %a out %a, answered %s in %a out %a", row.id.c_str(),
                row.kind.c_str(), row.hit ? "hit" : "miss", row.in, row.out,
                answer.outcome == Outcome::fault ? "fault"
                : hit                            ? "hit"
                                                 : "miss",
                answer.in, answer.out);
  return testing::AssertionFailure() << text;
}

testing::AssertionResult equals_recorded_kernel(const Answer& answer, const RecordedRow& row) {
  // Where BRL-CAD dropped the face there was nothing to test.
  if (answer.outcome == (row.kernel_hit ? Outcome::hit : Outcome::miss)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "row " << row.id << " (" << row.kind << "): recorded kernel_hit "
                                     << row.kernel_hit << ", answered otherwise";
}

// Returns how many rows there were.
std::size_t compare_all(const std::filesystem::path& directory) {
  std::size_t count = 0;
  for (const auto& file : recorded_files(directory)) {
    SCOPED_TRACE(file.filename().string());
    for (const RecordedRow& row : read_recorded_rows(file)) {
      const Bag bag = recorded_bag(row.triangle);
      EXPECT_TRUE(equals_recording(shoot("brlcad_bot_classic", bag, row.ray), row));
      EXPECT_TRUE(equals_recorded_kernel(shoot("brlcad_bot_classic_kernel", bag, row.ray), row));
      ++count;
    }
  }
  return count;
}

TEST(Recorded, SampleIsAnsweredBitForBit) { EXPECT_EQ(compare_all(recorded_sample()), 1913u); }

TEST(Recorded, SampleHoldsEveryKindOfRow) {
  std::set<std::string> kinds, exact;
  bool dropped = false;
  for (const auto& file : recorded_files(recorded_sample()))
    for (const RecordedRow& row : read_recorded_rows(file)) {
      kinds.insert(row.kind);
      exact.insert(row.exact);
      dropped |= !row.prepped;
      EXPECT_TRUE(row.prepped || !row.hit) << "row " << row.id << ": a dropped face cannot be hit";
    }
  EXPECT_EQ(kinds.size(), 58u);
  EXPECT_EQ(exact, (std::set<std::string>{"int", "edge", "vert", "out", "par"}));
  EXPECT_TRUE(dropped);
}

TEST(Recorded, FullRecordingsAreAnsweredBitForBit) {
  const auto directory = full_recordings();
  if (!directory) GTEST_SKIP() << "set PLUMBLINE_RECORDED to a directory of full recordings";
  const std::size_t count = compare_all(*directory);
  EXPECT_GT(count, 0u);
  RecordProperty("rows", static_cast<int>(count));
  std::printf("%zu recorded rows compared\n", count);
}

}  // namespace
}  // namespace plumbline
