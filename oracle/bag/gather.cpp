#include "oracle/bag/gather.h"

#include <algorithm>

#include "oracle/bag/hit_order.h"
#include "oracle/bag/owner.h"
#include "oracle/classify.h"
#include "oracle/exact_case.h"
#include "oracle/measure.h"
#include "oracle/round.h"

namespace plumbline {
namespace {

void gather_contact(BagTruth& truth, const Triangle& triangle, std::uint32_t index, const Query& query,
                    HitClass hit_class) {
  const exact::ExactCase x(triangle, query);
  const auto contact = exact::contact_in_range(x, query.ray);
  if (!contact) return;
  // A triangle is bounded, and so is what a line has in common with it.
  truth.stretches.push_back({.triangle = index,
                             .hit_class = hit_class,
                             .low = exact::rounded<double>(*contact->low),
                             .high = exact::rounded<double>(*contact->high)});
  truth.on_surface |= exact::contains(*contact, exact::Quotient(exact::Dyadic()));
}

}  // namespace

void gather(BagTruth& truth, const Triangle& triangle, std::uint32_t index, const Query& query) {
  const Truth one = classify(triangle, query);
  if (one.hit_class == HitClass::coplanar || one.hit_class == HitClass::degenerate)
    gather_contact(truth, triangle, index, query, one.hit_class);
  else if (crosses(one))
    truth.hits.push_back({.triangle = index, .truth = one});
}

void settle(BagTruth& truth, const Query& query, const std::function<const Triangle&(std::uint32_t)>& triangle) {
  std::ranges::sort(truth.stretches, {}, &Stretch::triangle);
  std::ranges::sort(truth.hits, [&](const BagHit& x, const BagHit& y) {
    const auto order = compare_t({triangle(x.triangle), x.truth}, {triangle(y.triangle), y.truth}, query);
    return order != 0 ? order < 0 : x.triangle < y.triangle;
  });
  for (std::size_t i = 0; i < truth.hits.size(); ++i) {
    BagHit& hit = truth.hits[i];
    const Triangle& here = triangle(hit.triangle);
    hit.t = measure<double>(here, query)->t;
    hit.owner = owns(here, query, hit.truth);
    if (hit.t == 0 && exact::ExactCase(here, query).T.sign() == 0) truth.on_surface = true;
    if (i == 0) continue;
    const BagHit& before = truth.hits[i - 1];
    const bool tied = compare_t({triangle(before.triangle), before.truth}, {here, hit.truth}, query) == 0;
    hit.rank = before.rank + (tied ? 0 : 1);
  }
}

}  // namespace plumbline
