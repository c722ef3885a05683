#include "oracle/bag/segments.h"

#include <algorithm>
#include <limits>

#include "oracle/bag/bag_truth.h"
#include "oracle/classify.h"
#include "oracle/default_controls.h"
#include "oracle/exact_case.h"
#include "oracle/round.h"

namespace plumbline {
namespace {

using exact::Dyadic;
using exact::Quotient;

// (p + k sqrt(q)) / r, q >= 0, r != 0, rounded once. The root is bracketed ever closer, until both ends of the bracket
// round to the same number: they do in the end, since the value is rational only where the first bracket is exact, and
// an irrational one is no tie.
double rounded_with_root(const Dyadic& p, const Dyadic& k, const Dyadic& q, const Dyadic& r) {
  mpz_class radicand = q.integer;
  long exponent = q.exponent;
  if (exponent % 2 != 0) {
    radicand *= 2;
    --exponent;
  }
  const auto value = [&](const mpz_class& root, long unit) { return Quotient(p + k * Dyadic(root, unit), r); };
  for (unsigned long bits = 128;; bits *= 2) {
    const mpz_class scaled = radicand << (2 * bits);
    const mpz_class root = sqrt(scaled);
    const long unit = exponent / 2 - static_cast<long>(bits);
    const double low = exact::rounded<double>(value(root, unit));
    if (root * root == scaled || low == exact::rounded<double>(value(root + 1, unit))) return low;
  }
}

}  // namespace

std::optional<std::vector<RaySegment>> inside(std::span<const Triangle> triangles, const Query& query) {
  const DefaultControls controls;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double t_min = query.ray.t_min, t_max = query.ray.t_max;
  Query line = query;  // from without to without
  line.ray.t_min = -infinity;
  line.ray.t_max = infinity;
  const BagTruth truth = bag_truth(triangles, line);
  if (truth.invalid != Invalid::none || !(t_min == t_min && t_max == t_max)) return std::nullopt;
  const auto crossings = truth.crossings();
  if (!crossings || *crossings % 2 != 0) return std::nullopt;
  std::vector<RaySegment> pieces;
  const BagHit* entry = nullptr;
  for (const BagHit& hit : truth.hits) {
    if (!hit.owner) continue;
    if (!entry) {
      entry = &hit;
      continue;
    }
    // Whether a length is left is told exactly; rounding keeps order, so the cut may be made after it.
    const bool some = t_min < t_max && entry->rank != hit.rank &&
                      classify(triangles[entry->triangle], query).versus_t_max < 0 &&
                      classify(triangles[hit.triangle], query).versus_t_min > 0;
    if (some) pieces.push_back({std::max(entry->t, t_min), std::min(hit.t, t_max)});
    entry = nullptr;
  }
  return pieces;
}

// With T, det, N of the triangle: t = T / det, and L in t is thickness |N| / |det|, or thickness / |D|.
std::optional<RaySegment> plate(const Bag& bag, std::uint32_t triangle, const Query& query) {
  const DefaultControls controls;
  const Triangle& face = bag.triangles[triangle];
  if (classify(face, query).hit_class > HitClass::vertex) return std::nullopt;
  const exact::ExactCase x(face, query);
  const Dyadic half = exact::abs(Dyadic(bag.thickness)) * Dyadic(1, -1);
  const Dyadic direction2 = square(x.direction);
  // t = p / r, and half of L = k sqrt(q) / r, with r > 0.
  const Dyadic sign(x.det.sign(), 0);
  const Dyadic r = bag.cosine ? sign * x.det : sign * x.det * direction2;
  const Dyadic p = bag.cosine ? sign * x.T : sign * x.T * direction2;
  const Dyadic k = bag.cosine ? half : half * sign * x.det;
  const Dyadic q = bag.cosine ? square(x.normal) : direction2;
  const auto at = [&](int halves) { return rounded_with_root(p, Dyadic(halves, 0) * k, q, r); };
  if (bag.position == PlatePosition::centred) return RaySegment{at(-1), at(1)};
  return RaySegment{at(0), at(2)};
}

}  // namespace plumbline
