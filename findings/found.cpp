#include "findings/found.h"

#include "analysis/ask.h"
#include "analysis/shrink.h"
#include "case/case_bytes.h"
#include "findings/build_line.h"

namespace plumbline {

FoundFinding found_finding(const TracerInfo& tracer, const Signature& signature, double ulps, const Case& what, std::string source) {
  const FuzzInput numbers{.precision = tracer.contract.precision, .triangle = what.bag.triangles.front(), .ray = what.ray};
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

std::optional<FoundFinding> ask_for_finding(const Tracer& tracer, const Case& what, std::string source) {
  const Case put = put_at(what, tracer.info().contract.precision);
  const Wish wish = what.aim ? what.aim->wish : Wish::none;
  const Examination e = Examiner(tracer, Measure::all, put.bag).examine(put.bag.triangles.front(), put.ray);
  const auto signed_as = signature(e, wish);
  if (!signed_as) return std::nullopt;
  return found_finding(tracer.info(), *signed_as, finding_ulps(e, *signed_as), put, std::move(source));
}

}  // namespace plumbline
