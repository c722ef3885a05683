// .case files as a regression test: the oracle derives each expectation again, and each tracer is judged, less the open
// findings that the files list as `known`.
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// Something that is not as the files say.
struct ReplayEvent {
  std::string file, id;  ///< of the case
  std::string message;
};

struct ReplaySummary {
  std::size_t files = 0, cases = 0, answers = 0;
  std::size_t known = 0;                               ///< answers that are wrong as the files say
  std::size_t faults = 0;                              ///< answers that were none, unlisted: no disagreement
  std::size_t skipped_known = 0;                       ///< `known` lines of tracers that were not asked
  std::map<std::string, std::size_t> unknown_tracers;  ///< names of no tracer, not even an absent one, and their lines
  std::vector<ReplayEvent> events;
  std::vector<Conduct> conduct;  ///< of each tracer
};

/// `paths` are files and folders; folders are searched, at any depth, for *.case. Throws InputError where there is
/// nothing to read, a file can't be read, or a case has other than one triangle.
ReplaySummary replay(const std::vector<std::string>& paths, const std::vector<const Tracer*>& tracers);

}  // namespace plumbline
