// Truth against answer, by the tracer's contract. Cheap and silent; `explain` tells why.
#pragma once
#include "case/answer.h"
#include "case/contract.h"
#include "case/geometry.h"
#include "case/verdict.h"
#include "oracle/truth.h"

namespace plumbline {

/// The ray that the contract says is traced: where the tracer doesn't read t_min and t_max, the range it searches.
Ray searched_ray(const Ray& ray, const Contract& contract);

/// What the contract says a right answer is; the arguments as for judge.
enum class Duty : unsigned char { hit, miss, any };
Duty duty(const Triangle& triangle, const Ray& ray, const Truth& truth, const Contract& contract);

/// `truth` is that of `triangle` and `searched_ray(ray, contract)`. The geometry is looked at only where the truth is
/// contact without a crossing, and where the contract has slack.
VerdictKind judge(const Triangle& triangle, const Ray& ray, const Truth& truth, const Answer& answer,
                  const Contract& contract);

}  // namespace plumbline
