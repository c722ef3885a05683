// .case files as a regression test: the oracle derives each expectation again, and each tracer is judged, of several
// triangles by what it hits first, less the open findings that the files list as `known`. What came out is told by
// reports/.
#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "case/verdict.h"
#include "float_tracer/tracer.h"
#include "oracle/severity.h"
#include "oracle/stated.h"

namespace plumbline {

struct ReplayedCase {
  std::string file;      ///< as the user named it, or as it was found in a folder that the user named
  std::string path;      ///< the same from the current folder on: as reports name it
  std::size_t line = 0;  ///< of its line `case`
  std::string id;
};

/// Of one tracer's answer to one case; or, without a tracer, of what the file expects of the case.
struct ReplayResult {
  std::size_t which = 0;               ///< of ReplaySummary::cases
  std::optional<std::size_t> tracer;   ///< of ReplaySummary::tracers
  std::optional<VerdictKind> verdict;  ///< on the answer
  std::optional<VerdictKind> known;    ///< as the file lists this tracer
  std::optional<Severity> severity;    ///< of a wrong answer; of several triangles without its condition
  std::string signature;               ///< of a wrong answer, as to_word has it (signature.h, bag_examine.h)
  std::optional<ReplayRule> rule;      ///< none: as the file says
  std::string message;                 ///< one line on the rule
  std::string why;                     ///< several lines: contract, answer, severity; the command that explains
};

inline bool disagrees(const ReplayResult& result) { return disagrees(result.rule, result.known); }

struct ReplaySummary {
  std::size_t files = 0;
  std::vector<ReplayedCase> cases;
  std::vector<std::string> tracers;  ///< their names
  std::vector<ReplayResult> results;  ///< case by case: the expectation, if there is one, then each tracer
  std::size_t skipped_known = 0;                       ///< `known` lines of tracers that were not asked
  std::map<std::string, std::size_t> unknown_tracers;  ///< names of no tracer, not even an absent one, and their lines
  std::vector<Conduct> conduct;                        ///< of each tracer

  std::size_t disagreements() const;
};

/// `paths` are files and folders; folders are searched, at any depth, for *.case. All is read before a tracer is
/// asked. Throws InputError where there is no case in a path, a file can't be read, or a case can't be judged
/// (cases_to_judge).
ReplaySummary replay(const std::vector<std::string>& paths, const std::vector<const Tracer*>& tracers);

}  // namespace plumbline
