#include "analysis/found_case.h"

#include <fmt/format.h>

#include <algorithm>

#include "oracle/classify.h"
#include "oracle/contact.h"
#include "oracle/measure.h"

namespace plumbline {
namespace {

Expectation expectation(const Triangle& triangle, const Ray& ray) {
  const Truth truth = classify(triangle, ray);
  Expectation e;
  e.hit_class = truth.hit_class;
  e.feature = truth.feature;
  e.hit = hit(triangle, ray, truth);
  if (const auto at = measure<double>(triangle, ray)) e.t = at->t, e.u = at->u, e.v = at->v;
  return e;
}

bool is_word(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) { return c > ' ' && c < 0x7f && c != '#'; });
}

std::optional<VerdictKind> verdict_of(FindingKind kind, std::size_t triangles) {
  switch (kind) {
    case FindingKind::false_miss: return VerdictKind::false_miss;
    case FindingKind::false_hit: return VerdictKind::false_hit;
    case FindingKind::leak: return triangles == 1 ? VerdictKind::false_miss : VerdictKind::leak;
    case FindingKind::wrong_nearest: return VerdictKind::wrong_nearest;
    case FindingKind::displaced:
    case FindingKind::not_finite:
    case FindingKind::death: break;
  }
  return std::nullopt;
}

}  // namespace

void set_known(Case& found, std::string_view tracer, FindingKind kind) {
  found.known.clear();
  if (!is_word(tracer)) return;
  const auto verdict = verdict_of(kind, found.bag.triangles.size());
  if (verdict) found.known = {{std::string(tracer), *verdict}};
}

void set_finding(Case& found, std::string_view tracer, FindingKind kind) {
  if (found.bag.triangles.size() == 1) found.expect = expectation(found.bag.triangles.front(), found.ray);
  set_known(found, tracer, kind);
}

std::string severity_text(double ulps, Conditioning conditioning) {
  return fmt::format("severity {:.6g} ulps of the largest coordinate, {}{}", ulps,
                     conditioning == Conditioning::nominal ? "" : "ill-conditioned: ", name(conditioning));
}

}  // namespace plumbline
