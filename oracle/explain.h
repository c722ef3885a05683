// Why: the exact numbers behind a class and a verdict, as text for people.
#pragma once
#include <optional>
#include <string>

#include "case/answer.h"
#include "case/contract.h"
#include "case/query.h"

namespace plumbline {

/// Several lines: the inputs in hexfloat and decimal, det, T and the w as integers times a power of two, what their
/// signs mean, t, u, v exact and rounded.
std::string explain(const Triangle& triangle, const Query& query);

/// The reason for the verdict on an answer: what the contract asks, what was said, the severity.
std::string explain_verdict(const Triangle& triangle, const Query& query, const Answer& answer, const Contract& contract);

}  // namespace plumbline
