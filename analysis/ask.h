// One case, one tracer, one verdict. Spans of rays against one bag are sweep.h's.
#pragma once
#include <optional>

#include "case/answer.h"
#include "case/case.h"
#include "case/contract.h"
#include "case/verdict.h"
#include "float_tracer/tracer.h"
#include "oracle/severity.h"
#include "oracle/truth.h"

namespace plumbline {

/// The case as it is really put to a tracer of that precision: rounded.
Case put_at(Case asked, Precision precision);

struct Reply {
  Query query;  ///< what the tracer was really asked
  Answer answer;
  Conduct conduct = {};  ///< what it did beside (the floating-point controls are as before)
};

/// What the tracer says of the case, put at its precision.
Reply ask(const Tracer& tracer, const Case& asked);

struct Judgement {
  Truth truth;  ///< of the query, in the range that the contract says is searched
  std::optional<bool> hit;  ///< the same, as contact.h says
  VerdictKind verdict = VerdictKind::correct;
  std::optional<Severity> severity;  ///< where the answer is wrong
};

constexpr bool wrong(VerdictKind verdict) {
  return verdict == VerdictKind::false_miss || verdict == VerdictKind::false_hit || verdict == VerdictKind::leak ||
         verdict == VerdictKind::wrong_nearest;
}

/// The answer to the ray of the case, put at the contract's precision. The bag holds exactly one triangle.
Judgement judge(const Case& asked, const Answer& answer, const Contract& contract);

/// The same of the query that the tracer was really asked.
Judgement judge(const Case& asked, const Reply& reply, const Contract& contract);

}  // namespace plumbline
