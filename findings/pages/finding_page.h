// One finding as a page: what is wrong, the proof, pictures, who else gets it wrong, and what to paste into a report.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "findings/pages/pages.h"

namespace plumbline {

struct FindingFiles {
  std::string page;   ///< HTML
  std::string cases;  ///< its simplest and its worst case as .case text
};

/// Of ranks[rank]; the others are linked. Asks its tracer, and all of options.tracers.
FindingFiles finding_files(std::span<const FindingRow* const> ranks, std::size_t rank, const PageOptions& options);

/// "finding-12.html"
std::string page_name(std::int64_t id, std::string_view extension);

}  // namespace plumbline
