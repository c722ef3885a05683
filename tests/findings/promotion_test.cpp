// Promoted cases: shrunk, with where they come from, in files whose names are safe and that overwrite nothing.
#include "findings/promotion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "case/case_text.h"
#include "case/input_error.h"
#include "findings/found.h"
#include "tests/analysis/fixed_tracer.h"
#include "tests/case/error_of.h"
#include "tests/findings/told.h"
#include "tests/fuzz/scratch.h"

namespace plumbline {
namespace {

using testing::AllOf;
using testing::HasSubstr;

FindingRow row_of(const std::string& tracer) {
  FindingRow row;
  row.tracer = tracer;
  row.signature = "false-hit-bc-nominal-c1";
  return row;
}

TEST(Promotion, FileNamesAreSafeAndDiffer) {
  EXPECT_EQ(file_stem(row_of("moller_trumbore_f64")), "moller_trumbore_f64-false-hit-bc-nominal-c1");
  std::vector<std::string> stems;
  const std::vector<std::string> names = {"a/b", "a b", "a\nb", "../a", ".a", "-a", "", "'; DROP", std::string(500, 'x'), "\xff"};
  for (const std::string& name : names) {
    const std::string stem = file_stem(row_of(name));
    EXPECT_EQ(stem.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-"), stem.npos)
        << stem;
    EXPECT_FALSE(stem.starts_with('.')) << stem;
    EXPECT_LT(stem.size(), 200u);
    EXPECT_EQ(std::ranges::find(stems, stem), stems.end()) << stem;
    stems.push_back(stem);
  }
}

TEST(Promotion, OverwritesNothing) {
  const Scratch scratch;
  const std::string folder = scratch.path() / "new" / "folder";
  Case one = told("t", "s", 1, 1, 1).found.what, two = told("t", "s", 1, 1, 2).found.what;
  EXPECT_EQ(put_in_folder(one, "stem", folder), folder + "/stem.case");
  EXPECT_EQ(put_in_folder(two, "stem", folder), folder + "/stem-2.case");
  EXPECT_EQ(put_in_folder(one, "stem", folder), folder + "/stem.case");  // the same again
  EXPECT_EQ(read_cases(folder + "/stem.case").at(0).ray, one.ray);
  EXPECT_EQ(read_cases(folder + "/stem-2.case").at(0).ray, two.ray);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 2);
}

TEST(Promotion, NamesAFolderThatCannotBe) {
  const Scratch scratch;
  const std::string file = scratch.path() / "file";
  std::ofstream(file) << "";
  EXPECT_THAT(error_of([&] { put_in_folder(told("t", "s", 1, 1).found.what, "stem", file); }), HasSubstr(file));
}

// A false hit where the ray passes at x = 1; at x = 0.25 it hits.
FindingRow row_kept(double worst, double simplest) {
  const FoundFinding f = *ask_for_finding(FixedTracer({a_hit}), told("", "", 1, 1, 1).found.what, "");
  FindingRow row;
  row.id = 7;
  row.tracer = f.tracer;
  row.signature = f.signature;
  row.kind = f.kind;
  row.worst.what = row.simplest.what = f.found.what;
  row.worst.what.ray.origin = {worst, worst, 1};
  row.simplest.what.ray.origin = {simplest, simplest, 1};
  row.worst.what.provenance = {"the worst"};
  row.simplest.what.provenance = {"the simplest"};
  return row;
}

TEST(Promotion, TakesTheCaseThatShowsTheFindingStill) {
  const FixedTracer hits({a_hit}), misses({a_miss});
  EXPECT_EQ(promoted(row_kept(1, 1), &hits).provenance.front(), "the worst");
  EXPECT_EQ(promoted(row_kept(1, 0.25), &hits).provenance.front(), "the worst");
  EXPECT_EQ(promoted(row_kept(0.25, 1), &hits).provenance.front(), "the simplest");
  EXPECT_EQ(promoted(row_kept(0.25, 1), nullptr).provenance.front(), "the worst");
  // Another edge is passed by: a false hit, but not of this signature.
  FindingRow other = row_kept(1, 1);
  other.worst.what.ray.origin = {-1, 0.5, 1};
  EXPECT_EQ(promoted(other, &hits).provenance.front(), "the simplest");
  other.simplest.what = other.worst.what;
  EXPECT_EQ(promoted(other, &hits).known, (std::vector{Known{"fixed", VerdictKind::false_hit}}));
  EXPECT_EQ(error_of([&] { promoted(row_kept(0.25, 0.25), &hits); }),
            "finding 7: fixed gets its worst case right and its simplest case right now; 'plumbline triage retest' "
            "closes what is fixed");
  EXPECT_THAT(error_of([&] { promoted(row_kept(1, 0.25), &misses); }),
              AllOf(HasSubstr("its worst case right and its simplest case otherwise wrong (false-miss-"),
                    HasSubstr("'plumbline triage set'")));
}

}  // namespace
}  // namespace plumbline
