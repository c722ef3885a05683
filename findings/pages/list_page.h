// The list of all findings as a page: what was searched, a map of tracers and conditions, and a table to filter and
// sort.
#pragma once
#include <span>
#include <string>

#include "findings/finding_row.h"

namespace plumbline {

/// `ranks` in the order to show; the first `paged` of them have pages of their own.
std::string list_page(std::span<const FindingRow* const> ranks, std::size_t paged,
                      std::span<const SearchRow> searches);

}  // namespace plumbline
