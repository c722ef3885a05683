// A finding as a regression test: a .case file that says where it comes from.
#pragma once
#include <string>

#include "findings/finding_row.h"
#include "float_tracer/tracer.h"

namespace plumbline {

/// The worst case, or the simplest where only that shows the finding still, shrunk as far as its condition stays the
/// same (Keep::nominal), and of several triangles to the fewest (bag_shrink.h), with provenance, expectation and
/// `known`. What can't be shrunk is as it was found; where `tracer` is null, that is the worst. Throws InputError where
/// neither case shows the finding.
Case promoted(const FindingRow& row, const Tracer* tracer);

/// What files of this finding are called: tracer and signature in letters that are safe in any file system. Names
/// that differ give names that differ.
std::string file_stem(const FindingRow& row);

/// Writes it as FOLDER/STEM.case, or STEM-2.case and so on where another case has that name, and returns the path;
/// the folder is made. A file that says the same stays. Nothing is ever overwritten. Throws InputError where it can't
/// be written.
std::string put_in_folder(Case what, const std::string& stem, const std::string& folder);

/// Makes the folder a project of CMake whose tests are its cases, put to the tracer (what --tracer takes; a path is told from
/// the folder on). It needs an installed Plumbline (docs/regressions.md). Throws InputError where the folder has a
/// CMakeLists.txt that says something else.
void make_ctest_project(const std::string& folder, const std::string& tracer);

}  // namespace plumbline
