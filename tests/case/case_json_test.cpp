#include "case/case_json.h"

#include <gtest/gtest.h>

namespace plumbline {
namespace {

TEST(CaseJson, WritesOneLine) {
  Case made;
  made.id = "x";
  made.bag.triangles = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  made.ray = {{0x1p-2, 0x1p-2, 1}, {0, 0, -1}};
  std::string text;
  append_json(text, made);
  EXPECT_EQ(text, R"({"id":"x","triangle":[[0,0,0],[1,0,0],[0,1,0]],"origin":[0.25,0.25,1],"direction":[0,0,-1],)"
                  "\"t_min\":0,\"t_max\":null}\n");
}

}  // namespace
}  // namespace plumbline
