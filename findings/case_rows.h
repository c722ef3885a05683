// Findings straight from .case files, without a store: each case is asked again, and what is still wrong is sorted by
// tracer and signature. What it tells of time is that of the files.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "findings/finding_row.h"

namespace plumbline {

/// A .case file or a folder of them, whose cases the tracers of their lines `known` get wrong; and beside these, if
/// there is one, `tracer`.
struct CasePath {
  std::string path, tracer;
};

struct CaseRows {
  std::vector<FindingRow> rows;
  std::size_t right = 0;                       ///< cases of a tracer that gets them right, now
  std::map<std::string, std::size_t> unknown;  ///< tracers that this build doesn't know, and their cases
};

/// Throws InputError where there is nothing to read, a file can't be read, or a case has several
/// triangles that aren't surfaces.
CaseRows rows_of_cases(const std::vector<CasePath>& paths);

/// Of a file, UTC, as finding_row.h has it.
std::string time_of(const std::string& file);

}  // namespace plumbline
