// .case files against a function of one's own, in one's own process: for unit tests. `plumbline replay` is the same
// for tracers that are plugged in.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "case/contract.h"
#include "case/geometry.h"

namespace plumbline {

/// What is under test.
struct CorpusTracer {
  std::string name;        ///< as lines `known` call it
  Contract contract = {};  ///< what it promises; where that is binary32, it is given numbers of binary32 only
  std::function<std::optional<bool>(const Triangle&, const Ray&)> hits;  ///< no value: a fault
  // Of several triangles each is asked for alone, and if one is hit they are. Which of them is hit first that can't
  // tell, and where it is known for telling it wrong, nothing is told.
};

/// A line "file:line: id: what" for everything that is not as the files say, followed by the reason; empty: all is.
/// `path` is a file, or a folder, searched for *.case at any depth. Throws InputError where there is no case, a file
/// can't be read, or a case can't be judged (cases_to_judge).
std::string check_corpus(const std::string& path, const CorpusTracer& tracer);

}  // namespace plumbline
