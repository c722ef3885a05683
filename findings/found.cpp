#include "findings/found.h"

#include <fmt/format.h>

#include <limits>

#include "analysis/ask.h"
#include "analysis/bag_shrink.h"
#include "analysis/shrink.h"
#include "case/case_bytes.h"
#include "findings/build_line.h"
#include "oracle/judge.h"

namespace plumbline {

namespace {

// What is the same of one triangle and of several.
FoundFinding found_in(const TracerInfo& tracer, FoundCase found, std::string source) {
  FoundFinding f;
  f.tracer = tracer.name;
  f.found = std::move(found);
  f.found.what.precision = tracer.contract.precision;
  f.build = build_line(tracer);
  f.source = std::move(source);
  return f;
}

FindingKind kind(BagVerdict verdict, std::size_t triangles) {
  switch (verdict_kind(verdict)) {
    case VerdictKind::leak: return triangles == 1 ? FindingKind::false_miss : FindingKind::leak;
    case VerdictKind::wrong_nearest: return FindingKind::wrong_nearest;
    case VerdictKind::fault: return FindingKind::death;
    default: return FindingKind::false_hit;
  }
}

Conditioning conditioning(const Case& what, const Contract& contract, BagVerdict verdict) {
  const auto examined = [&](std::uint32_t triangle) {
    return examine(what.bag.triangles[triangle], what.ray, what.ray, {}, contract);
  };
  Conditioning found = Conditioning::nominal;
  if (verdict == BagVerdict::fault) return found;
  if (verdict == BagVerdict::false_hit) {
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < what.bag.triangles.size(); ++i) {
      const Examination e = examined(i);
      if (!e.margins || !(e.margins->severity_ulps < least)) continue;
      least = e.margins->severity_ulps;
      found = conditioning(e).first;
    }
    return found;
  }
  const BagTruth truth = bag_truth(what.bag.triangles, searched_ray(what.ray, contract));
  int worst = -1;
  for (std::size_t i = 0; i < truth.nearest(); ++i) {
    const auto [here, bucket] = conditioning(examined(truth.hits[i].triangle));
    if (bucket <= worst) continue;
    worst = bucket;
    found = here;
  }
  return found;
}

}  // namespace

FoundFinding found_finding(const TracerInfo& tracer, const Signature& signature, double ulps, const Case& what,
                           std::string source) {
  const FuzzInput numbers{
      .precision = tracer.contract.precision, .triangle = what.bag.triangles.front(), .ray = what.ray};
  FoundFinding f =
      found_in(tracer, {.ulps = ulps, .bits = significant_bits(numbers), .what = what}, std::move(source));
  f.signature = to_word(signature);
  f.kind = signature.kind;
  f.element = signature.element;
  f.conditioning = signature.conditioning;
  return f;
}

FoundFinding found_bag_finding(const TracerInfo& tracer, const BagSignature& signature, const BagJudgement& judgement,
                               const Case& what, std::string source) {
  FoundFinding f =
      found_in(tracer, {.ulps = judgement.ulps, .bits = significant_bits(what), .what = what}, std::move(source));
  f.kind = kind(signature.verdict, what.bag.triangles.size());
  f.conditioning = conditioning(what, tracer.contract, signature.verdict);
  f.signature = to_word(signature);
  if (f.conditioning != Conditioning::nominal) f.signature += fmt::format("-{}", name(f.conditioning));
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
  if (put.bag.triangles.size() > 1) {
    const BagExamination e = examine_bag(tracer, put);
    const auto found = signature(e);
    if (!found) return std::nullopt;
    return found_bag_finding(tracer.info(), *found, e.judgement, put, std::move(source));
  }
  return signed_finding(asked_again(tracer, put), tracer.info(), put, std::move(source));
}

}  // namespace plumbline
