#include "oracle/judge.h"

#include <limits>

#include "case/float_bits.h"
#include "oracle/contact.h"
#include "oracle/severity.h"

namespace plumbline {
namespace {

Duty duty(TouchRule rule) {
  switch (rule) {
    case TouchRule::hit: return Duty::hit;
    case TouchRule::miss: return Duty::miss;
    case TouchRule::unspecified: break;
  }
  return Duty::any;
}

Duty at_end(EndRule rule) {
  switch (rule) {
    case EndRule::closed: return Duty::hit;
    case EndRule::open: return Duty::miss;
    case EndRule::unspecified: break;
  }
  return Duty::any;
}

Duty on_boundary(EdgeRule rule) {
  switch (rule) {
    case EdgeRule::closed: return Duty::hit;
    case EdgeRule::open: return Duty::miss;
    case EdgeRule::one_owner:
    case EdgeRule::unspecified: break;
  }
  return Duty::any;
}

// A hit needs every part to be one; a part that must miss settles it.
Duty both(Duty x, Duty y) {
  if (x == Duty::miss || y == Duty::miss) return Duty::miss;
  return x == Duty::any || y == Duty::any ? Duty::any : Duty::hit;
}

bool culled(const Truth& truth, const Contract& contract) {
  return (contract.culling == Culling::back && truth.det_sign > 0) ||
         (contract.culling == Culling::front && truth.det_sign < 0);
}

}  // namespace

Query searched_ray(const Query& query, const Contract& contract) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Query r = query;
  if (contract.range == RangeRule::given) return r;
  r.ray.t_min = contract.range == RangeRule::line ? -inf : 0;
  r.ray.t_max = inf;
  return r;
}

Duty duty(const Triangle& triangle, const Query& query, const Truth& truth, const Contract& contract) {
  const auto touched = [&](Duty rule) { return touches(triangle, searched_ray(query, contract)) ? rule : Duty::miss; };
  switch (truth.hit_class) {
    case HitClass::invalid: return Duty::any;
    case HitClass::exterior:
    case HitClass::parallel: return Duty::miss;
    case HitClass::coplanar: return touched(duty(contract.coplanar));
    case HitClass::degenerate: return touched(duty(contract.degenerate));
    case HitClass::interior:
    case HitClass::edge:
    case HitClass::vertex: break;
  }
  if (!crosses(truth) || culled(truth, contract)) return Duty::miss;
  Duty r = truth.hit_class == HitClass::interior ? Duty::hit : on_boundary(contract.edges);
  if (truth.versus_t_min == 0) r = both(r, at_end(contract.t_min));
  if (truth.versus_t_max == 0) r = both(r, at_end(contract.t_max));
  return r;
}

VerdictKind judge(const Triangle& triangle, const Query& query, const Truth& truth, const Answer& answer,
                  const Contract& contract) {
  if (answer.outcome == Outcome::fault) return VerdictKind::fault;
  const bool answered_hit = answer.outcome == Outcome::hit;
  switch (duty(triangle, query, truth, contract)) {
    case Duty::any: return VerdictKind::unspecified;
    case Duty::hit: return answered_hit ? VerdictKind::correct : VerdictKind::false_miss;
    case Duty::miss: break;
  }
  if (!answered_hit) return VerdictKind::correct;
  const bool has_slack = !is_zero(contract.slack_absolute) || !is_zero(contract.slack_relative);
  if (has_slack && !culled(truth, contract) &&
      within_slack(triangle, searched_ray(query, contract), contract.slack_absolute, contract.slack_relative))
    return VerdictKind::correct;
  return VerdictKind::false_hit;
}

}  // namespace plumbline
