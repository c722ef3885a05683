#include "oracle/contact.h"

#include "oracle/exact_case.h"

namespace plumbline {

bool touches(const Triangle& triangle, const Query& query) {
  return exact::contact_in_range(exact::ExactCase(triangle, query), query.ray).has_value();
}

std::optional<bool> hit(const Triangle& triangle, const Query& query, const Truth& truth) {
  switch (truth.hit_class) {
    case HitClass::interior:
    case HitClass::edge:
    case HitClass::vertex: return crosses(truth);
    case HitClass::exterior:
    case HitClass::parallel: return false;
    case HitClass::coplanar:
    case HitClass::degenerate: return touches(triangle, query) ? std::nullopt : std::optional(false);
    case HitClass::invalid: break;
  }
  return std::nullopt;
}

}  // namespace plumbline
