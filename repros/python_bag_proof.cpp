// The same as python_proof.cpp of several triangles: all that the ray crosses, in exact order.
#include <fmt/format.h>

#include "analysis/bag_examine.h"
#include "analysis/tracers.h"
#include "case/float_bits.h"
#include "case/input_error.h"
#include "case/real_text.h"
#include "oracle/bag/explain_bag.h"
#include "oracle/judge.h"
#include "repros/evidence.h"
#include "repros/forms.h"
#include "repros/text.h"

namespace plumbline {
namespace {

constexpr std::string_view text = R"python(#!/usr/bin/env python3
# A proof in exact fractions of which triangles a ray crosses, and in what order. It needs Python alone, and exits
# with 0 if every step holds.
#
@STORY@
from fractions import Fraction


def exact(*hexfloats):
    """Each float is a fraction of integers. Nothing is rounded from here on."""
    return [Fraction(float.fromhex(x)) for x in hexfloats]


TRIANGLES = [                           # counted from 0
@TRIANGLES@]
@RAY@

def minus(p, q): return [x - y for x, y in zip(p, q)]
def dot(p, q): return sum(x * y for x, y in zip(p, q))
def cross(p, q): return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]


def crossing(A, B, C):
    """Where the ray crosses the triangle: t, and at what of it; None where it doesn't, or runs along its plane."""
    e1, e2, a = minus(B, A), minus(C, A), minus(A, O)
    N, h = cross(e1, e2), cross(D, a)   # N: normal of the triangle, as long as twice its area
    det = dot(D, N)
    if det == 0:
        return None
    t, u, v = dot(a, N) / det, -dot(e2, h) / det, dot(e1, h) / det
    w = 1 - u - v
    P = [o + t * d for o, d in zip(O, D)]
    assert P == [w * x + u * y + v * z for x, y, z in zip(A, B, C)]  # the mean of A, B, C with the weights w, u, v
    if min(u, v, w) < 0 or (T_MIN is not None and t < T_MIN) or (T_MAX is not None and t > T_MAX):
        return None                     # beyond an edge, or an end of the ray
    return t, {(): "interior", ("A",): "edge bc", ("B",): "edge ca", ("C",): "edge ab", ("B", "C"): "vertex a",
               ("A", "C"): "vertex b", ("A", "B"): "vertex c"}[
                   tuple(name for name, weight in (("A", w), ("B", u), ("C", v)) if weight == 0)]


hits = [(*found, k) for k, found in ((k, crossing(*abc)) for k, abc in enumerate(TRIANGLES)) if found]
hits.sort(key=lambda hit: (hit[0], hit[2]))
for t, at, k in hits:
    print(f"t = {t} (about {float(t)}): triangle {k}, {at}")
assert [(k, at) for t, at, k in hits] == [@HITS@]
first = {k for t, at, k in hits if t == hits[0][0]}
print("Truth: " + (f"the ray crosses {len(hits)} of them, first {sorted(first)}." if hits else "the ray crosses none."))
@ANSWER@)python";

std::string vector_text(const Vec3& v) {
  return fmt::format("exact(\"{}\", \"{}\", \"{}\")", hexfloat(v.x), hexfloat(v.y), hexfloat(v.z));
}

std::string end_text(double t) { return is_finite(t) ? fmt::format("exact(\"{}\")[0]", hexfloat(t)) : "None"; }

std::string triangles_text(const Case& what) {
  std::string lines;
  for (const auto& [a, b, c] : what.bag.triangles)
    lines += fmt::format("    ({},\n     {},\n     {}),\n", vector_text(a), vector_text(b), vector_text(c));
  return lines;
}

std::string ray_text(const Query& query) {
  const auto& [o, d, t_min, t_max] = query.ray;
  std::string lines = fmt::format("O = {}\nD = {}\n", vector_text(o), vector_text(d));
  if (query.has_tail())
    lines += fmt::format("D = [x + y for x, y in zip(D, {})]  # two points are what is asked: their exact difference\n",
                         vector_text(query.direction_tail));
  return lines + fmt::format("T_MIN, T_MAX = {}, {}  # None: without end\n", end_text(t_min), end_text(t_max));
}

std::string hits_text(const BagTruth& truth) {
  std::string list;
  for (const BagHit& hit : truth.hits)
    list += fmt::format("{}({}, \"{}\")", list.empty() ? "" : ", ", hit.triangle, met_at(hit.truth));
  return list;
}

// What was said, beside what is true.
std::string answer_text(const BagExamination& e) {
  const bool names = e.answer.outcome == Outcome::hit && e.answer.has_t;
  std::string lines = fmt::format("print(\"It said: {}{}.\")\n", said(e.answer),
                                  names ? fmt::format(", of triangle {}", e.answer.triangle) : "");
  switch (e.judgement.verdict) {
    case BagVerdict::leak: return lines + "print(\"That is wrong: one of them has to be hit.\")\n";
    case BagVerdict::wrong_nearest:
      return lines + fmt::format("assert {} not in first\nprint(\"That is wrong: another has to be hit first.\")\n",
                                 e.answer.triangle);
    case BagVerdict::false_hit: return lines + "print(\"That is wrong: it has to be a miss.\")\n";
    default: return lines;
  }
}

std::string headline(const Case& what, std::string_view tracer, const std::optional<BagExamination>& e) {
  if (tracer.empty()) return "Where a ray meets triangles, exactly.";
  const std::string who = harmless(tracer);
  if (!e) return fmt::format("What does {} say of this ray?", who);
  if (e->judgement.verdict == BagVerdict::fault) return fmt::format("{} gives no answer to this ray.", who);
  if (e->judgement.verdict == BagVerdict::unspecified)
    return fmt::format("{} leaves open what it says of this ray: no answer is wrong.", who);
  if (!e->wrong()) return fmt::format("{} gets this ray right.", who);
  const std::string by = e->judgement.ulps > 0
                             ? fmt::format(", by {:.4g} ulps of the largest coordinate", e->judgement.ulps)
                             : "";
  return fmt::format("{} gets {} triangles wrong: {}{}.", who, what.bag.triangles.size(), name(e->judgement.verdict),
                     by);
}

}  // namespace

std::string python_bag_proof(const Case& what, std::string_view tracer) {
  const Tracer* const here = tracer.empty() ? nullptr : tracer_named(tracer);
  const Contract contract = here ? here->info().contract : Contract{.precision = what.precision};
  require_precision(what, contract.precision, tracer.empty() ? "the case's own precision" : tracer);
  std::optional<BagExamination> e;
  if (here) e = examine_bag(*here, what);
  const Query query = e ? e->query : Query(what.ray);
  const BagTruth truth = e ? e->truth : bag_truth(what.bag.triangles, query);
  if (truth.invalid != Invalid::none)
    throw InputError(
        fmt::format("case '{}': {}, so nothing is true of it; export another", what.id, reason(truth.invalid)));
  std::string story = headline(what, tracer, e) + "\n\n    python3 proof.py\n\n";
  story += fmt::format("case       {}\n", harmless(what.id));
  for (const std::string& line : what.provenance) story += fmt::format("           {}\n", harmless(line));
  if (e) story += explain_bag_verdict({what.bag.triangles, query, truth, contract}, e->answer, e->judgement);
  story += explain_bag(what.bag.triangles, query, truth);
  return fill(text, {{"STORY", commented(story, "# ")},
                     {"TRIANGLES", triangles_text(what)},
                     {"RAY", ray_text(query)},
                     {"HITS", hits_text(truth)},
                     {"ANSWER", e ? answer_text(*e) : ""}});
}

}  // namespace plumbline
