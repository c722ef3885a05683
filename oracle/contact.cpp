#include "oracle/contact.h"

#include "oracle/exact_case.h"

namespace plumbline {

bool touches(const Triangle& triangle, const Ray& ray) {
  return exact::contact_in_range(exact::ExactCase(triangle, ray), ray).has_value();
}

std::optional<bool> hit(const Triangle& triangle, const Ray& ray, const Truth& truth) {
  switch (truth.hit_class) {
    case HitClass::interior:
    case HitClass::edge:
    case HitClass::vertex: return crosses(truth);
    case HitClass::exterior:
    case HitClass::parallel: return false;
    case HitClass::coplanar:
    case HitClass::degenerate: return touches(triangle, ray) ? std::nullopt : std::optional(false);
    case HitClass::invalid: break;
  }
  return std::nullopt;
}

}  // namespace plumbline
