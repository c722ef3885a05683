#include "findings/found.h"

#include "analysis/ask.h"
#include "analysis/shrink.h"
#include "case/case_bytes.h"
#include "findings/build_line.h"

namespace plumbline {

FoundFinding found_finding(const TracerInfo& tracer, const Signature& signature, double ulps, const Case& what,
                           std::string source) {
  const FuzzInput numbers{
      .precision = tracer.contract.precision, .triangle = what.bag.triangles.front(), .ray = what.ray};
  FoundFinding f{.tracer = tracer.name,
                 .signature = to_word(signature),
                 .kind = signature.kind,
                 .element = signature.element,
                 .conditioning = signature.conditioning,
                 .found = {.ulps = ulps, .bits = significant_bits(numbers), .what = what},
                 .build = build_line(tracer),
                 .source = std::move(source),
                 .seen = {}};
  f.found.what.precision = tracer.contract.precision;
  return f;
}

namespace {

std::optional<FoundFinding> signed_finding(const Examination& e, const TracerInfo& tracer, const Case& what,
                                           std::string source) {
  const auto found = signature(e, what.aim ? what.aim->wish : Wish::none);
  if (!found) return std::nullopt;
  return found_finding(tracer, *found, finding_ulps(e, *found), what, std::move(source));
}

Examination asked_again(const Tracer& tracer, const Case& what) {
  return Examiner(tracer, Measure::all, what.bag).examine(what.bag.triangles.front(), what.ray);
}

}  // namespace

std::optional<FoundFinding> finding_in_answer(const TracerInfo& info, const Tracer* tracer, const Case& what,
                                              const Query& asked, const Answer& answer, std::string source) {
  const Examination given = examine(what.bag.triangles.front(), what.ray, asked, answer, info.contract);
  if (tracer) {
    const Examination now = asked_again(*tracer, what);
    if (now.verdict == given.verdict) return signed_finding(now, info, what, std::move(source));
  }
  return signed_finding(given, info, what, std::move(source));
}

std::optional<FoundFinding> ask_for_finding(const Tracer& tracer, const Case& what, std::string source) {
  const Case put = put_at(what, tracer.info().contract.precision);
  return signed_finding(asked_again(tracer, put), tracer.info(), put, std::move(source));
}

}  // namespace plumbline
