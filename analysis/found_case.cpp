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

}  // namespace

void set_known(Case& found, std::string_view tracer, FindingKind kind) {
  found.known.clear();
  if (!is_word(tracer)) return;
  if (kind == FindingKind::false_hit) found.known = {{std::string(tracer), VerdictKind::false_hit}};
  if (kind == FindingKind::false_miss) found.known = {{std::string(tracer), VerdictKind::false_miss}};
}

void set_finding(Case& found, std::string_view tracer, FindingKind kind) {
  found.expect = expectation(found.bag.triangles.front(), found.ray);
  set_known(found, tracer, kind);
}

std::string severity_text(double ulps, Conditioning conditioning) {
  return fmt::format("severity {:.6g} ulps of the largest coordinate, {}{}", ulps,
                     conditioning == Conditioning::nominal ? "" : "ill-conditioned: ", name(conditioning));
}

}  // namespace plumbline
