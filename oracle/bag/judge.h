// Truth against answers at the level of a bag, by the tracer's contract; for one triangle, oracle/judge.h.
//
// What a contract asks for comes from what it says of each triangle (duty):
// - Of the triangles met at one t, at least one must be hit where one of them must: with closed edges that is any of
//   them, else one that is met inside.
// - With exactly one owner it is also a point that triangles share all around, consistently oriented, so that the ray
//   goes through them once: there exactly one is hit.
// - A triangle that is touched without being crossed must be hit where the contract says so.
// - Where triangles are met or touched and none of them must be hit, the contract is silent.
// Where an answer breaks nothing, nothing had to be hit and something may be, the verdict is unspecified.
//
// Each verdict has a severity of its own, in lengths and in units in the last place, at the contract's precision, of
// the largest coordinate of the triangles and the origin concerned. 0 where convention alone is broken: an edge, an
// end of the range, a culled side; and of triangles without area.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "case/answer.h"
#include "case/contract.h"
#include "case/query.h"
#include "case/verdict.h"
#include "oracle/bag/bag_truth.h"
#include "oracle/bag/segments.h"

namespace plumbline {

enum class BagVerdict : unsigned char {
  correct,
  leak,             ///< a point that must be hit, and none of its triangles is: by the greatest severity of missing one
  false_hit,        ///< a hit where none must be: by the greatest severity of a hit that isn't there
  wrong_nearest,    ///< a hit must be, but of others: by the way along the ray to the one reported, if the ray crosses
                    ///< it; else by the severity of hitting it
  double_hit,       ///< more hits than triangles crossed, or than owners: by the greatest severity of one too many
  wrong_order,      ///< t of two hits the wrong way round: by their exact distance along the ray
  wrong_parity,     ///< of a closed bag: by the greatest severity of a triangle's answer that is wrong
  wrong_thickness,  ///< pieces of the ray that are taken for inside, or aren't: by the length of the longest
  unspecified,
  fault,  ///< no answer, or one that names a triangle that isn't there
};
inline constexpr std::array<std::string_view, 10> bag_verdict_names = {
    "correct",     "leak",         "false-hit",       "wrong-nearest", "double-hit",
    "wrong-order", "wrong-parity", "wrong-thickness", "unspecified",   "fault"};
constexpr std::string_view name(BagVerdict v) { return bag_verdict_names[static_cast<unsigned>(v)]; }

/// A verdict of judge_nearest as .case files call it. Throws std::logic_error for one that it doesn't give.
VerdictKind verdict_kind(BagVerdict verdict);

struct BagJudgement {
  BagVerdict verdict = BagVerdict::correct;
  double length = 0, ulps = 0;  ///< the severity
  // Of judge_nearest:
  HitClass due = HitClass::exterior;  ///< of the first point that must be hit: the least exceptional class of its
                                      ///< triangles; exterior: there is none
  std::uint32_t due_rank = 0;         ///< and its rank, where there is one
  bool behind = false;                ///< wrong_nearest: the ray does meet what is reported, behind that point
};

/// What was really asked. `truth` is that of the triangles and the query, whose range is the one searched
/// (searched_ray in oracle/judge.h).
struct BagQuestion {
  std::span<const Triangle> triangles;
  const Query& query;
  const BagTruth& truth;
  const Contract& contract;
  bool severities = true;  ///< false: none is measured, all are 0; faster
};

/// The answer to the bag as a whole: correct, leak, false_hit, wrong_nearest, unspecified or fault. A hit without t
/// says only that something is hit; where nothing is, its severity is the least among the triangles.
BagJudgement judge_nearest(const BagQuestion& question, const Answer& answer);

/// All that is hit, in any order: of triangles asked one by one, or all along the ray. The same verdicts, and
/// double_hit. A point that must be hit and isn't is a leak though others are; wrong_nearest, if something is hit
/// that isn't there.
BagJudgement judge_hits(const BagQuestion& question, std::span<const Answer> hits);

/// Hits that say t, of triangles that are crossed: correct or wrong_order. Equal t are in order.
BagJudgement judge_order(const BagQuestion& question, std::span<const Answer> hits);

/// All hits of a closed bag: correct, wrong_parity, or unspecified: where the ray begins on the surface, meets an
/// edge or vertex that may be hit more than once or not at all, touches a triangle without crossing it, or the
/// contract has slack or culls.
BagJudgement judge_parity(const BagQuestion& question, std::span<const Answer> hits);

/// Where the ray is inside, as answered and exactly (segments.h); each is the union of its pieces. correct, or
/// wrong_thickness where a piece longer than `leeway`, a length, is in one of them alone. An end that is NaN:
/// infinitely wrong.
BagJudgement judge_segments(const BagQuestion& question, std::span<const RaySegment> answered,
                            std::span<const RaySegment> exact, double leeway);

/// Of a leak or a wrong nearest hit of the whole bag: whether it was lost on the way, in boxes and traversal, and not
/// by the triangle test. It was if the tracer, asked with one of the triangles crossed alone, hits it (wrong nearest:
/// with one of those that were due, and nearer than what it reported, by its own t).
bool lost_by_culling(const BagJudgement& judgement, const BagTruth& truth, const Answer& answer,
                     std::span<const Answer> hits_alone);

}  // namespace plumbline
