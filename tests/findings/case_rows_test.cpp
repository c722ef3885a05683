#include "findings/case_rows.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/case/error_of.h"
#include "tests/fuzz/scratch.h"
#include "tests/several.h"

namespace plumbline {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

class CaseRowsTest : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    const auto path = scratch_.path() / name;
    std::ofstream(path) << text;
    return path.string();
  }
  std::string folder() const { return scratch_.path().string(); }

 private:
  Scratch scratch_;
};

// Rays that this kernel misses, though they meet the edge bc exactly: one third isn't a binary32 number.
constexpr const char* thirds =
    "case thirds\nprecision binary32\ntriangle 2 -1 0  1 0 1  0 0 0\nray -1 1 0  1.5 -1 0.5\nknown "
    "woop_watertight_f32 false-miss\n";
constexpr const char* well_hit = "triangle 0 0 0  1 0 0  0 1 0\nray 0.25 0.25 1  0 0 -1\n";

TEST_F(CaseRowsTest, TellTheSimplestAndTheWorstOfEachSignature) {
  write("a.case", thirds);
  write("b.case", std::string(thirds).replace(5, 6, "again"));
  const CaseRows all = rows_of_cases({{folder(), ""}});
  ASSERT_EQ(all.rows.size(), 1u);
  const FindingRow& row = all.rows.front();
  EXPECT_EQ(row.id, 1);
  EXPECT_EQ(row.tracer, "woop_watertight_f32");
  EXPECT_EQ(row.signature, "false-miss-bc-by-bc-exactly-nominal-c0");
  EXPECT_EQ(row.kind, FindingKind::false_miss);
  EXPECT_EQ(row.element, Element::bc);
  EXPECT_EQ(row.conditioning, Conditioning::nominal);
  EXPECT_EQ(row.count, 2u);
  EXPECT_EQ(row.worst.ulps, 0);
  EXPECT_EQ(row.worst.what.id, "thirds");
  EXPECT_THAT(row.first_seen, MatchesRegex("20..-..-..T..:..:..Z"));
  EXPECT_LE(row.first_seen, row.last_seen);
}

TEST_F(CaseRowsTest, LeaveOutWhatIsRightOrUnknown) {
  const auto path = write(
      "x.case", "case hit\n" + std::string(well_hit) + "known plucker_f64 false-miss\nknown nobody false-hit\n");
  const CaseRows all = rows_of_cases({{path, ""}});
  EXPECT_TRUE(all.rows.empty());
  EXPECT_EQ(all.right, 1u);
  EXPECT_EQ(all.unknown.at("nobody"), 1u);
}

TEST_F(CaseRowsTest, AskTheTracerOfTheFolderToo) {
  const auto path = write("x.case", std::string(thirds).substr(0, std::string(thirds).find("known")));
  EXPECT_TRUE(rows_of_cases({{path, ""}}).rows.empty());
  EXPECT_EQ(rows_of_cases({{path, "woop_watertight_f32"}}).rows.size(), 1u);
}

TEST_F(CaseRowsTest, RefuseWhatIsNoCase) {
  EXPECT_THAT(error_of([&] { rows_of_cases({{folder() + "/none.case", ""}}); }), HasSubstr("none.case"));
  EXPECT_THAT(error_of([&] { rows_of_cases({{folder(), ""}}); }), HasSubstr("no *.case file"));
  const auto solid = write("solid.case", leaking_pair + "mode solid\nknown moller_trumbore_f64 leak\n");
  EXPECT_THAT(error_of([&] { rows_of_cases({{solid, ""}}); }), HasSubstr("a solid of 2 triangles"));
}

TEST_F(CaseRowsTest, TellOfSeveralTriangles) {
  const auto path = write("pair.case", leaking_pair + "known moller_trumbore_f64 leak\nknown exact leak\n");
  const CaseRows all = rows_of_cases({{path, ""}});
  ASSERT_EQ(all.rows.size(), 1u);
  EXPECT_EQ(all.rows[0].signature, "leak-interior");
  EXPECT_EQ(all.rows[0].kind, FindingKind::leak);
  EXPECT_EQ(all.rows[0].worst.what.bag.triangles.size(), 2u);
  EXPECT_EQ(all.right, 1u);
}

}  // namespace
}  // namespace plumbline
