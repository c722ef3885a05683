// The truth in Python's exact fractions, step by step, for a reader who trusts none of our code. Which steps there
// are depends on the class; each is an assertion with its reason behind it.
#include <fmt/format.h>

#include <cmath>

#include "case/float_bits.h"
#include "case/real_text.h"
#include "oracle/contact.h"
#include "repros/evidence.h"
#include "repros/forms.h"
#include "repros/text.h"

namespace plumbline {
namespace {

constexpr std::string_view command = "python3 proof.py";

constexpr std::string_view text = R"(#!/usr/bin/env python3
# A proof in exact fractions of where a ray meets a triangle. It needs Python alone, and exits with 0 if every step
# holds.
#
@STORY@
from fractions import Fraction


def exact(*hexfloats):
    """Each float is a fraction of integers. Nothing is rounded from here on."""
    return [Fraction(float.fromhex(x)) for x in hexfloats]


@CASE@

def minus(p, q): return [x - y for x, y in zip(p, q)]
def dot(p, q): return sum(x * y for x, y in zip(p, q))
def cross(p, q): return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]


e1, e2, a = minus(B, A), minus(C, A), minus(A, O)
N, h = cross(e1, e2), cross(D, a)       # N: normal of the triangle, as long as twice its area
det, T = dot(D, N), dot(a, N)           # the ray's speed towards the plane, its distance from it, both times |N|
@STEPS@@ANSWER@)";

constexpr std::string_view crossing_text = R"python(
assert det != 0                         # the line crosses the plane of the triangle, once
w_AB, w_CA = dot(e1, h), -dot(e2, h)    # on which side of each edge it does
w_BC = det - w_AB - w_CA
t, u, v, w = T / det, w_CA / det, w_AB / det, w_BC / det
P = [o + t * d for o, d in zip(O, D)]   # there
assert dot(minus(P, A), N) == 0         # P is in the plane, and the mean of A, B, C with the weights w, u, v:
assert w + u + v == 1 and P == [w * x + u * y + v * z for x, y, z in zip(A, B, C)]
print(f"det = {det}\nT = {T}\nw_AB = {w_AB}\nw_BC = {w_BC}\nw_CA = {w_CA}")
print(f"t = {t}\nu = {u} (weight of B)\nv = {v} (of C)\nw = {w} (of A)")
@ROUNDED@@WHERE@)python";

constexpr std::string_view touching_text = R"(
touched = []                            # where the line meets an edge or a vertex; elsewhere it can't come in
for p, q in (A, B), (B, C), (C, A):
    beside_p, beside_q = cross(D, minus(p, O)), cross(D, minus(q, O))  # 0: on the line; opposite: on its two sides
    if not any(beside_p):
        touched.append(p)
    elif not any(cross(beside_p, beside_q)) and dot(beside_p, beside_q) < 0:
        s = dot(beside_p, beside_p) / dot(beside_p, minus(beside_p, beside_q))
        touched.append([x + s * (y - x) for x, y in zip(p, q)])
ts = []
for p in touched:
    ts.append(dot(minus(p, O), D) / dot(D, D))
    assert p == [o + ts[-1] * d for o, d in zip(O, D)]
ts.sort()
)";

std::string vector_line(std::string_view name, const Vec3& v) {
  return fmt::format("{} = exact(\"{}\", \"{}\", \"{}\")  # ({})\n", name, hexfloat(v.x), hexfloat(v.y),
                     hexfloat(v.z), decimals(v));
}

std::string end_text(double t) { return is_finite(t) ? fmt::format("exact(\"{}\")[0]", hexfloat(t)) : "None"; }

std::string case_text(const Evidence& e) {
  const Triangle& t = e.triangle();
  const auto& [o, d, t_min, t_max] = e.query.ray;
  std::string lines = vector_line("A", t.a) + vector_line("B", t.b) + vector_line("C", t.c) + vector_line("O", o) +
                      vector_line("D", d);
  if (e.query.has_tail()) {
    lines += vector_line("TAIL", e.query.direction_tail);
    lines +=
        "D = [x + y for x, y in zip(D, TAIL)]  # two points are what is asked, and this is their exact difference\n";
  }
  const std::string ends = is_finite(t_min) && is_finite(t_max) ? "" : "  # None: without end";
  return lines + fmt::format("T_MIN, T_MAX = {}, {}{}\n", end_text(t_min), end_text(t_max), ends);
}

std::string step(std::string_view claim, std::string_view reason) {
  return fmt::format("{:<39} # {}\n", "assert " + std::string(claim), reason);
}

std::string truth_line(std::string_view words) { return fmt::format("print(\"Truth: {}\")\n", words); }

// Rounded once from the exact value: the double that a perfect tracer would print.
std::string rounded_text(const Evidence& e) {
  std::string lines;
  const auto add = [&lines](std::string_view name, double x) {
    if (is_finite(x))
      lines +=
          fmt::format("assert float({}) == float.fromhex(\"{}\")  # {}\n", name, hexfloat(x), shortest_decimal(x));
  };
  const auto m = measure<double>(e.triangle(), e.query);
  add("t", m->t), add("u", m->u), add("v", m->v);
  return lines;
}

struct Signs {
  std::string_view claim, reason, words;
};

Signs on(Feature feature) {
  switch (feature) {
    case Feature::ab: return {"v == 0 and w > 0 and u > 0", "no weight of C: P is on edge AB", "meets edge AB"};
    case Feature::bc: return {"w == 0 and u > 0 and v > 0", "no weight of A: P is on edge BC", "meets edge BC"};
    case Feature::ca: return {"u == 0 and w > 0 and v > 0", "no weight of B: P is on edge CA", "meets edge CA"};
    case Feature::a: return {"w == 1 and u == v == 0 and P == A", "all weight is A's", "meets vertex A"};
    case Feature::b: return {"u == 1 and v == w == 0 and P == B", "all weight is B's", "meets vertex B"};
    case Feature::c: return {"v == 1 and u == w == 0 and P == C", "all weight is C's", "meets vertex C"};
    case Feature::none: break;
  }
  return {"w > 0 and u > 0 and v > 0", "all weights are positive: P is inside", "crosses the interior"};
}

std::string range_text(const Evidence& e, std::string_view words) {
  const auto& [o, d, t_min, t_max] = e.query.ray;
  if (e.truth.versus_t_min < 0)
    return step(is_finite(t_min) ? "t < T_MIN" : "False", "before the ray begins") +
           truth_line(fmt::format("the line {}, but before t_min: the ray misses.", words));
  if (e.truth.versus_t_max > 0)
    return step(is_finite(t_max) ? "t > T_MAX" : "False", "behind the ray's end") +
           truth_line(fmt::format("the line {}, but behind t_max: the ray misses.", words));
  std::string lines;
  if (is_finite(t_min))
    lines += e.truth.versus_t_min == 0 ? step("t == T_MIN", "exactly where the ray begins")
                                       : step("t > T_MIN", "after the ray begins");
  if (is_finite(t_max))
    lines += e.truth.versus_t_max == 0 ? step("t == T_MAX", "exactly where the ray ends")
                                       : step("t < T_MAX", "before the ray ends");
  return lines + truth_line(fmt::format("the ray {}.", words));
}

std::string outside_text() {
  return step("min(u, v, w) < 0", "a weight against the others: P is beyond an edge, outside") +
         "print(\"P is beyond\", \", \".join(edge for edge, x in ((\"AB\", v), (\"BC\", w), (\"CA\", u)) if x < "
         "0))\n" +
         truth_line("the line passes outside the triangle: the ray misses.");
}

std::string touching(const Evidence& e) {
  const auto& [o, d, t_min, t_max] = e.query.ray;
  std::string lines(touching_text);
  std::string within = "ts";
  if (is_finite(t_min)) within += " and ts[-1] >= T_MIN";
  if (is_finite(t_max)) within += " and ts[0] <= T_MAX";
  const bool touches = !hit(e.triangle(), e.query, e.truth);
  lines +=
      "print(f\"the line is in the triangle from t = {ts[0]} to {ts[-1]}\" if ts else \"the line meets no point of "
      "it\")\n";
  if (touches)
    return lines + step(within, "in the ray's range, too") +
           truth_line("the ray touches the triangle without crossing it: a matter of convention.");
  return lines + step("not (" + within + ")", "so the ray meets no point") + truth_line("the ray misses.");
}

std::string steps(const Evidence& e) {
  switch (e.truth.hit_class) {
    case HitClass::exterior: return fill(crossing_text, {{"ROUNDED", rounded_text(e)}, {"WHERE", outside_text()}});
    case HitClass::parallel:
      return "\n" + step("any(N)", "a triangle with an area,") + step("det == 0", "the ray runs along its plane,") +
             step("T != 0", "and not in it") + "print(f\"det = {det}\\nT = {T}\")\n" +
             truth_line("the ray runs beside the plane: it misses.");
    case HitClass::coplanar:
      return "\n" + step("any(N)", "a triangle with an area,") +
             step("det == 0 and T == 0", "and the ray runs in its plane") + touching(e);
    case HitClass::degenerate:
      return "\n" + step("not any(N)", "no area: the triangle is a segment or a point") + touching(e);
    default: {
      const Signs signs = on(e.truth.feature);
      return fill(crossing_text, {{"ROUNDED", rounded_text(e)},
                                  {"WHERE", step(signs.claim, signs.reason) + range_text(e, signs.words)}});
    }
  }
}

// What was said, beside what is true.
std::string answer_text(const Evidence& e) {
  if (!e.answer) return "";
  std::string lines = fmt::format("\nprint(\"It said: {}.\")\n", said(*e.answer));
  if (!e.wrong) return lines;
  const auto far_off = [&lines](std::string_view name, double answered, double leeway) {
    lines += fmt::format(
        "assert abs({} - exact(\"{}\")[0]) > Fraction({})  # a hit may be off by 2^-10 of the longest edge\n", name,
        hexfloat(answered), fmt::format("float.fromhex(\"{}\")", hexfloat(leeway)));
  };
  const auto off = [](double answered, double exact, double leeway) { return std::abs(answered - exact) > leeway; };
  const Answer& a = *e.answer;
  switch (*e.wrong) {
    case FindingKind::false_hit: return lines + "print(\"That is wrong: the ray misses.\")\n";
    case FindingKind::false_miss: return lines + "print(\"That is wrong: the ray hits.\")\n";
    case FindingKind::not_finite: return lines + "print(\"That is wrong: t, u and v are finite.\")\n";
    case FindingKind::death:
    case FindingKind::leak:  // these two are of several triangles
    case FindingKind::wrong_nearest: return lines;
    case FindingKind::displaced: break;
  }
  if (a.has_t && off(a.t, e.exact->t, e.leeway->t)) far_off("t", a.t, e.leeway->t);
  if (a.has_uv && off(a.u, e.exact->u, e.leeway->u)) far_off("u", a.u, e.leeway->u);
  if (a.has_uv && off(a.v, e.exact->v, e.leeway->v)) far_off("v", a.v, e.leeway->v);
  return lines + "print(\"That is wrong: a hit it is, but not there.\")\n";
}

}  // namespace

std::string python_proof(const Case& what, std::string_view tracer) {
  const Evidence e = gather(what, tracer, Contract{.precision = what.precision});
  return fill(text, {{"STORY", commented(story(e, command), "# ")},
                     {"CASE", case_text(e)},
                     {"STEPS", steps(e)},
                     {"ANSWER", answer_text(e)}});
}

}  // namespace plumbline
