// Why, of several triangles: where the ray meets them, in order, and the verdict on what was said. For one triangle,
// oracle/explain.h.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "case/answer.h"
#include "oracle/bag/bag_truth.h"
#include "oracle/bag/judge.h"

namespace plumbline {

/// Several lines: the ray; each t at which triangles are crossed, exact and rounded, with those triangles, at what of
/// them, from which side, and who owns a hit that they share; what is touched without being crossed. `truth` is that of
/// the triangles and the query.
std::string explain_bag(std::span<const Triangle> triangles, const Query& query, const BagTruth& truth);

/// The verdict of judge_nearest, what had to be hit, what was said, and the contract.
std::string explain_bag_verdict(const BagQuestion& question, const Answer& answer, const BagJudgement& judgement);

/// The triangles that matter, each once: those that had to be hit first, the one reported, then all others that are
/// crossed or touched. Without answer and judgement, these alone.
std::vector<std::uint32_t> concerned(const BagQuestion& question, const Answer& answer = {},
                                     const BagJudgement& judgement = {});

/// "edge bc", "interior"
std::string met_at(const Truth& truth);

}  // namespace plumbline
