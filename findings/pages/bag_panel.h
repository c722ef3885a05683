// A case of several triangles on a finding's page: what is said, what is true, and all that the ray meets, in order. Of
// one triangle, the page itself tells.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "analysis/bag_examine.h"
#include "findings/finding_row.h"

namespace plumbline {

struct BagLook {
  Case put;  ///< at the tracer's precision
  Query query;                        ///< what was really asked, in the range that is searched
  BagTruth truth;                     ///< of that
  std::optional<BagExamination> now;  ///< where this build has the tracer
  double ulps = 0;                    ///< how badly it is wrong; where the tracer is missing or right, what was found
};

/// `tracer` may be null.
BagLook look_at_several(const FoundCase& found, const Tracer* tracer);

/// What the finding comes to, by its worst case: a sentence of HTML.
std::string in_short(const FindingRow& row, const BagLook& worst);

/// A section of HTML.
std::string panel(std::string_view title, const FindingRow& row, const FoundCase& found, const BagLook& look);

}  // namespace plumbline
