#include "case/case_files.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/case/error_of.h"
#include "tests/fuzz/scratch.h"

namespace plumbline {
namespace {

using testing::ElementsAre;
using testing::EndsWith;

const std::string geometry = "triangle 0 0 0  1 0 0  0 1 0\nray 0.25 0.25 1  0 0 -1\n";

class CaseFiles : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    const auto path = scratch_.path() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path;
  }
  std::string folder() const { return scratch_.path(); }

 private:
  Scratch scratch_;
};

TEST_F(CaseFiles, OfAFolderAtAnyDepthSorted) {
  const std::string b = write("b.case", ""), deep = write("a/deep/x.case", "");
  write("a/x.txt", "");
  write("c.case/x.txt", "");  // a folder of that name is none
  EXPECT_THAT(case_files(folder()), ElementsAre(deep, b));
  EXPECT_THAT(case_files(b), ElementsAre(b));
  EXPECT_THAT(case_files("-"), ElementsAre("-"));
  EXPECT_EQ(error_of([&] { case_files(folder() + "/c.case"); }), folder() + "/c.case: no *.case file in this folder");
}

TEST_F(CaseFiles, CasesKnowTheirLines) {
  const std::string file =
      write("x.case", "# A remark.\n\n# Why.\ncase one\n" + geometry + "known t fault\n\r\n case two\n" + geometry);
  const auto placed = read_placed_cases(file);
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_EQ(placed[0].line, 4u);
  EXPECT_EQ(placed[1].line, 9u);
  EXPECT_EQ(placed[0].what.provenance, std::vector<std::string>{"Why."});
  EXPECT_EQ((std::vector{placed[0].what, placed[1].what}), read_cases(file));
}

TEST_F(CaseFiles, WhatCantBeJudgedIsTold) {
  EXPECT_EQ(cases_to_judge(write("fine.case", "case x\n" + geometry)).size(), 1u);
  const std::string empty = write("empty.case", "# nothing\n"),
                    two = "case x\n" + geometry + "triangle 0 0 0  1 0 0  0 1 0\n";
  EXPECT_EQ(error_of([&] { cases_to_judge(empty); }), empty + ": no case in this file");
  EXPECT_EQ(cases_to_judge(write("two.case", two + "known t leak\nknown u wrong-nearest\n")).size(), 1u);
  const std::string solid = write("solid.case", two + "mode solid\n");
  const std::string told = write("told.case", two + "expect interior\n");
  EXPECT_EQ(error_of([&] { cases_to_judge(solid); }),
            solid + ": case 'x' is a solid of 2 triangles, and several are judged as surfaces; remove its line 'mode'");
  EXPECT_EQ(error_of([&] { cases_to_judge(told); }),
            told + ": case 'x' has 2 triangles, and a line 'expect' is of one; remove it");
  EXPECT_THAT(error_of([&] { cases_to_judge(folder() + "/none.case"); }),
              EndsWith("cannot be opened: No such file or directory"));
}

}  // namespace
}  // namespace plumbline
