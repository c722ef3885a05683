#include "analysis/tally.h"

#include "oracle/contact.h"
#include "oracle/judge.h"

namespace plumbline {

Tally& operator+=(Tally& sum, const Tally& more) {
  sum.attempts += more.attempts;
  sum.successes += more.successes;
  sum.exact_successes += more.exact_successes;
  sum.false_misses += more.false_misses;
  sum.false_hits += more.false_hits;
  sum.lucky_misses += more.lucky_misses;
  sum.lucky_hits += more.lucky_hits;
  sum.unlucky_harness_errors += more.unlucky_harness_errors;
  sum.unspecified += more.unspecified;
  sum.faults += more.faults;
  return sum;
}

std::optional<bool> right_answer(const Triangle& triangle, const Query& query, const Truth& truth, const Contract& contract) {
  switch (duty(triangle, query, truth, contract)) {
    case Duty::hit: return true;
    case Duty::miss: return false;
    case Duty::any: break;
  }
  return hit(triangle, searched_ray(query, contract), truth);
}

void count(Tally& tally, Wish wish, std::optional<bool> right_answer, Outcome outcome, VerdictKind verdict) {
  const bool wished = wish == Wish::hit;
  const bool answered = outcome == Outcome::hit;
  const bool success = outcome != Outcome::fault && answered == wished;
  const bool right = verdict == VerdictKind::correct;
  const bool false_miss = verdict == VerdictKind::false_miss, false_hit = verdict == VerdictKind::false_hit;
  tally.attempts += 1;
  tally.successes += success;
  tally.exact_successes += right_answer == wished;
  tally.false_misses += false_miss;
  tally.false_hits += false_hit;
  tally.lucky_misses += false_miss && success;
  tally.lucky_hits += false_hit && success;
  tally.unlucky_harness_errors += right && !success && right_answer == answered;
  tally.unspecified += verdict == VerdictKind::unspecified || (right && right_answer != answered);
  tally.faults += verdict == VerdictKind::fault;
}

}  // namespace plumbline
