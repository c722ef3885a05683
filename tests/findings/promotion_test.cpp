// Promoted cases: shrunk, with where they come from, in files whose names are safe and that overwrite nothing.
#include "findings/promotion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "case/case_text.h"
#include "case/input_error.h"
#include "tests/case/error_of.h"
#include "tests/findings/told.h"
#include "tests/fuzz/scratch.h"

namespace plumbline {
namespace {

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

}  // namespace
}  // namespace plumbline
