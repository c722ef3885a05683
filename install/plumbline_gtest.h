// .case files as a GoogleTest test of a function of one's own:
//
//   TEST(MyTracer, IsRightOnTheCorpus) {
//     EXPECT_TRUE(plumbline::right_on_corpus("corpus", {.name = "my_tracer", .hits = my_hits}));
//   }
//
// where my_hits takes a plumbline::Triangle and a plumbline::Ray, and returns whether it hits. What it promises other
// than closed edges and the ray's closed range is said in .contract (case/contract.h). A failure tells, for each
// case, the exact margin and the exact numbers behind it. Link plumbline::oracle and GoogleTest.
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "oracle/check_corpus.h"

namespace plumbline {

/// `path` is a .case file, or a folder that is searched for them at any depth. Throws InputError, which GoogleTest
/// reports as a failure, where there is no case.
inline testing::AssertionResult right_on_corpus(const std::string& path, const CorpusTracer& tracer) {
  const std::string found = check_corpus(path, tracer);
  if (found.empty()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "not as the .case files say:\n" << found;
}

}  // namespace plumbline
