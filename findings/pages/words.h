// Findings in plain words, as plain text: what a stranger reads first.
#pragma once
#include <string>

#include "findings/pages/look.h"

namespace plumbline {

/// Three significant digits: 143, 0.17, 1.65e14.
std::string short_number(double x);
/// "143 ulps", "1 ulp".
std::string in_ulps(double ulps);

/// What the tracer does: "calls this a hit; the ray passes outside edge BC".
std::string what_is_wrong(const FindingRow& row);

/// How bad a severity above 0 is, by two measures that everybody has: the rounding of one coordinate, and the size of
/// the triangle.
std::string how_bad(double ulps, double longest_edge_ulps);

/// "A", "edge BC", "the start of the range"
std::string part_name(Element element);

}  // namespace plumbline
