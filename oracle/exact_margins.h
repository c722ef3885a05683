// The margins of any case, by way of GMP. Private to the oracle.
#pragma once
#include <optional>

#include "oracle/margins.h"

namespace plumbline {

/// As margins, each double rounded correctly.
std::optional<Margins> exact_margins(const Triangle& triangle, const Query& query, Precision precision);

}  // namespace plumbline
