// Where cases come from that are put to a tracer, by the name of the source: a family of case/hard_families.h, the
// report's rays, or .case files.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"

namespace plumbline {

/// The report's rays: those that `plumbline sweep` fires without options. Not a family.
inline constexpr std::string_view report_source = "lattice";

/// All sources that are no path: `lattice`, then the families.
std::vector<std::string_view> source_names();

struct SourceOptions {
  std::optional<std::uint64_t> count;  ///< at most; none: 1000 of a family, and all of what is finite
  std::uint64_t seed = 1;              ///< of a family
  std::optional<Precision> precision;  ///< to round all cases to; none: as they are
};

/// Calls `take` for each case. The ids are distinct within a family and within the report's rays. Rounding may leave a
/// case infinite or without a direction: it stays, and the oracle calls it invalid. Throws InputError where the source
/// is neither a name nor there, or can't be read.
void generate(const std::string& source, const SourceOptions& options, const std::function<void(const Case&)>& take);

}  // namespace plumbline
