// What bag_truth and Scene share: how the truth of a bag is put together from those of its triangles. Private to the
// oracle.
#pragma once
#include <functional>

#include "oracle/bag/bag_truth.h"

namespace plumbline {

/// Adds what the ray has to do with triangle `index`: to hits (unordered, t and owner open), stretches (unordered),
/// on_surface. Valid triangles and queries.
void gather(BagTruth& truth, const Triangle& triangle, std::uint32_t index, const Query& query);

/// Brings hits and stretches into order, ranks the hits and fills in t and owner. Default controls.
void settle(BagTruth& truth, const Query& query, const std::function<const Triangle&(std::uint32_t)>& triangle);

}  // namespace plumbline
