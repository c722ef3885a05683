#include "oracle/bag/bag_truth.h"

#include <algorithm>

#include "case/finite.h"
#include "case/input_error.h"
#include "oracle/bag/gather.h"
#include "oracle/default_controls.h"
#include "oracle/invalid.h"

namespace plumbline {

std::size_t BagTruth::nearest() const { return static_cast<std::size_t>(std::ranges::count(hits, 0u, &BagHit::rank)); }

std::optional<std::uint32_t> BagTruth::crossings() const {
  if (on_surface) return std::nullopt;
  return static_cast<std::uint32_t>(std::ranges::count_if(hits, &BagHit::owner));
}

// det < 0: the front is met, so the ray goes in.
std::optional<std::int32_t> BagTruth::signed_crossings() const {
  if (on_surface) return std::nullopt;
  std::int32_t sum = 0;
  for (const BagHit& hit : hits)
    if (hit.owner) sum += hit.truth.det_sign;
  return sum;
}

BagTruth bag_truth(std::span<const Triangle> triangles, const Query& query) {
  const DefaultControls controls;
  BagTruth truth;
  // A triangle that is certainly valid, so that the ray's faults are seen where the bag is empty.
  truth.invalid = why_invalid(Triangle{}, query.ray);
  for (std::uint32_t i = 0; i < triangles.size() && truth.invalid == Invalid::none; ++i)
    truth.invalid = why_invalid(triangles[i], query.ray);
  if (truth.invalid != Invalid::none) return truth;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) gather(truth, triangles[i], i, query);
  settle(truth, query, [&](std::uint32_t i) -> const Triangle& { return triangles[i]; });
  return truth;
}

std::optional<std::int32_t> winding_number(std::span<const Triangle> triangles, const Vec3& point) {
  const BagTruth truth = bag_truth(triangles, Ray{.origin = point, .direction = {1, 0, 0}});
  if (truth.invalid != Invalid::none)
    throw InputError("the winding number around a point: the point or a triangle is not finite");
  return truth.signed_crossings();
}

}  // namespace plumbline
