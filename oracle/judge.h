// Truth against answer, by the tracer's contract. Cheap and silent; `explain` tells why.
#pragma once
#include "case/answer.h"
#include "case/contract.h"
#include "case/query.h"
#include "case/verdict.h"
#include "oracle/truth.h"

namespace plumbline {

/// The ray that the contract says is traced: where the tracer doesn't read t_min and t_max, the range it searches.
Query searched_ray(const Query& query, const Contract& contract);

/// What the contract says a right answer is; the arguments as for judge.
enum class Duty : unsigned char { hit, miss, any };
Duty duty(const Triangle& triangle, const Query& query, const Truth& truth, const Contract& contract);

/// `truth` is that of `triangle` and `searched_ray(query, contract)`. The geometry is looked at only where the truth is
/// contact without a crossing, and where the contract has slack.
VerdictKind judge(const Triangle& triangle, const Query& query, const Truth& truth, const Answer& answer,
                  const Contract& contract);

}  // namespace plumbline
