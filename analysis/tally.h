// Wish, truth and answer of many rays, counted apart.
//
// Wish != truth is a harness error, answer != truth a tracer error, answer = wish != truth a lucky success: a tracer
// error that looks like a success. Truth is that of the query which the tracer was really asked: what its interface
// loses of the ray counts as a harness error. Where nothing is unspecified and nothing a fault,
//   attempts - successes = harness_errors + false_misses + false_hits - 2 lucky
// since a ray fails exactly when one of harness error and tracer error happens, but not both. Each ray that is
// unspecified or a fault may put this out by one, either way: it fails or not, and is nobody's error.
#pragma once
#include <cstdint>
#include <optional>

#include "case/answer.h"
#include "case/case.h"
#include "case/contract.h"
#include "case/query.h"
#include "case/verdict.h"
#include "oracle/truth.h"

namespace plumbline {

struct Tally {
  std::uint64_t attempts = 0;
  std::uint64_t successes = 0;        ///< answer = wish
  std::uint64_t exact_successes = 0;  ///< truth = wish
  std::uint64_t false_misses = 0;     ///< answer against truth
  std::uint64_t false_hits = 0;
  std::uint64_t lucky_misses = 0;            ///< false misses with answer = wish
  std::uint64_t lucky_hits = 0;              ///< false hits with answer = wish
  std::uint64_t unlucky_harness_errors = 0;  ///< failures of a right answer: answer = truth != wish
  std::uint64_t unspecified = 0;  ///< the contract leaves the answer open, or excuses one that isn't the truth (slack)
  std::uint64_t faults = 0;       ///< no answer
  std::uint64_t harness_errors() const { return attempts - exact_successes; }
  std::uint64_t lucky() const { return lucky_misses + lucky_hits; }
  friend bool operator==(const Tally&, const Tally&) = default;
};

/// Merging two tallies is adding them, in any order.
Tally& operator+=(Tally& sum, const Tally& more);

/// Whether a right answer is a hit: what the contract asks, or, where that is silent, the closed triangle's truth. No
/// value where that is open too. The arguments as for judge() in oracle/judge.h.
std::optional<bool> right_answer(const Triangle& triangle, const Query& query, const Truth& truth, const Contract& contract);

/// Adds one ray. `wish` is not Wish::none.
void count(Tally& tally, Wish wish, std::optional<bool> right_answer, Outcome outcome, VerdictKind verdict);

}  // namespace plumbline
