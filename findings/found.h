// A finding as it is told to a store, and the same wrong answer asked for again.
#pragma once
#include <optional>
#include <string>

#include "analysis/bag_examine.h"
#include "analysis/examine.h"
#include "analysis/signature.h"
#include "findings/event.h"
#include "float_tracer/tracer.h"

namespace plumbline {

/// `what` has one triangle and numbers of the tracer's precision.
FoundFinding found_finding(const TracerInfo& tracer, const Signature& signature, double ulps, const Case& what,
                           std::string source);

/// `what` has several triangles, or what is left of them, and numbers of the tracer's precision; the verdict is of
/// judge_nearest. The signature is its word, and where the case is ill-conditioned by what: "leak-edge-culling",
/// "wrong-nearest-interior-grazing". That is told of the triangle that is crossed first, the worst where several are;
/// of a false hit, of the one that is nearest to being hit; a death has no condition. A leak of one triangle is a false
/// miss.
FoundFinding found_bag_finding(const TracerInfo& tracer, const BagSignature& signature, const BagJudgement& judgement,
                               const Case& what, std::string source);

/// An answer that somebody got from a tracer; `what` has one triangle and numbers of the tracer's precision, and
/// `asked` is what the tracer was really asked of its ray. Where the `tracer` itself is at hand it is asked again,
/// since it alone can tell by which of its tests it missed, and whether numbers over- or underflowed; if it says
/// otherwise now, or is null, the signature is without these.
std::optional<FoundFinding> finding_in_answer(const TracerInfo& info, const Tracer* tracer, const Case& what,
                                              const Query& asked, const Answer& answer, std::string source);

/// Asks the tracer about the case, of one triangle or several, put at its precision. No value where there is nothing
/// to find.
std::optional<FoundFinding> ask_for_finding(const Tracer& tracer, const Case& what, std::string source);

}  // namespace plumbline
