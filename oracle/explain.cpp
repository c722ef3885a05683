#include "oracle/explain.h"

#include <fmt/format.h>

#include "oracle/classify.h"
#include "oracle/contact.h"
#include "oracle/exact_case.h"
#include "oracle/explain_lines.h"
#include "oracle/judge.h"
#include "oracle/round.h"
#include "oracle/severity.h"

namespace plumbline {
namespace {

using namespace exact;

// In lowest form: an odd integer times a power of two.
std::string dyadic(const Dyadic& x) {
  if (x.sign() == 0) return "0";
  const auto twos = mpz_scan1(x.integer.get_mpz_t(), 0);
  const mpz_class odd = x.integer >> twos;
  const long exponent = x.exponent + static_cast<long>(twos);
  return exponent == 0 ? odd.get_str() : fmt::format("{} * 2^{}", odd.get_str(), exponent);
}

std::string fraction(const Quotient& x) {
  const mpq_class r = to_mpq(x);
  return r.get_num().get_str() + "/" + r.get_den().get_str();
}

ExactNumber exact_number(const Dyadic& x) { return {.exact = dyadic(x), .sign = x.sign()}; }

ExactRatio exact_ratio(const Quotient& x) {
  return {.exact = fraction(x), .binary64 = rounded<double>(x), .binary32 = rounded<float>(x)};
}

std::string where(const Truth& truth) {
  switch (truth.hit_class) {
    case HitClass::interior: return "all three w have the sign of det: the line crosses the interior";
    case HitClass::edge: return fmt::format("one w is zero, the others have the sign of det: the line meets edge {}", name(truth.feature));
    case HitClass::vertex: return fmt::format("two w are zero: the line meets vertex {}", name(truth.feature));
    case HitClass::exterior: return "a w has the sign against det: the line passes outside";
    case HitClass::parallel: return "det = 0 and T != 0: the line runs beside the plane";
    case HitClass::coplanar: return "det = 0 and T = 0: the line runs in the plane";
    case HitClass::degenerate: return "(b-a) x (c-a) = 0: the triangle is a segment or a point";
    case HitClass::invalid: return std::string(reason(truth.invalid));
  }
  return "";
}

std::string versus_range(const Quotient& t, const Ray& ray) {
  const auto searched = range(ray);
  if (!searched) return "the range holds no t";
  if (searched->low && t < *searched->low) return "t < t_min: before the range";
  if (searched->high && t > *searched->high) return "t > t_max: behind the range";
  if (searched->low && t == *searched->low) return "t = t_min: the range's closed start";
  if (searched->high && t == *searched->high) return "t = t_max: the range's closed end";
  return "t_min < t < t_max";
}

void add_side(Lines& lines, std::string_view label, const ExactNumber& w, const ExactNumber& det) {
  lines.add(label, "{}   ({})", w.exact, side(w.sign, det.sign));
}

void add_coordinate(Lines& lines, std::string_view label, const ExactRatio& x) {
  lines.add(label, "{}", x.exact);
  lines.add("", "binary64 {}   binary32 {:a}", number(x.binary64), x.binary32);
}

void add_contact(Lines& lines, const ExactCase& x, const Ray& ray) {
  const auto touched = contact(x);
  if (!touched) {
    lines.add("contact", "the line meets no point of the closed triangle");
    return;
  }
  lines.add("contact", "t from {} to {}", fraction(*touched->low), fraction(*touched->high));
  lines.add("", "{}", contact_in_range(x, ray) ? "it holds points of the t range: whether that is a hit is a matter of convention"
                                               : "no point of it lies in the t range: a miss");
}

std::string condition_words(const Condition& c) {
  if (c.nominal()) return "nominal";
  std::string words = "ill-conditioned:";
  if (c.grazing) words += " grazing (sin of ray and plane below 2^-10)";
  if (c.sliver) words += " sliver (least altitude / longest edge below 2^-10)";
  if (c.far) words += " far (longest edge / largest coordinate below 2^-10)";
  return words;
}

void add_vertices(Lines& lines, const Triangle& triangle) {
  lines.add("a", "{}", point(triangle.a));
  lines.add("b", "{}", point(triangle.b));
  lines.add("c", "{}", point(triangle.c));
}

void add_certificate(Lines& lines, const Triangle& triangle, const Query& query) {
  const Certificate c = certificate(triangle, query);
  if (c.truth.hit_class == HitClass::invalid) {
    lines.add("class", "invalid: {}", c.where);
    return;
  }
  lines.add("det", "{}", c.det.exact);
  lines.add("T", "{}", c.T.exact);
  if (c.det.sign != 0) {
    add_side(lines, "w_ab", c.w_ab, c.det);
    add_side(lines, "w_bc", c.w_bc, c.det);
    add_side(lines, "w_ca", c.w_ca, c.det);
  }
  lines.add("class", "{}: {}", name(c.truth.hit_class), c.where);
  if (c.det.sign != 0) {
    add_coordinate(lines, "t = T/det", *c.t);
    lines.add("", "{}", c.range);
    add_coordinate(lines, "u", *c.u);
    add_coordinate(lines, "v", *c.v);
  } else if (c.truth.hit_class != HitClass::parallel) {
    add_contact(lines, ExactCase(triangle, query), query.ray);
  }
  lines.add("hit", "{}", !c.hit ? "open: contact without a crossing" : *c.hit ? "yes" : "no");
}

}  // namespace

std::string_view side(int w_sign, int det_sign) {
  const int s = w_sign * det_sign;
  return s > 0 ? "the sign of det: inner side" : s < 0 ? "against the sign of det: outer side" : "zero: on the edge line";
}

Certificate certificate(const Triangle& triangle, const Query& query) {
  Certificate c;
  c.truth = classify(triangle, query);
  c.where = where(c.truth);
  if (c.truth.hit_class == HitClass::invalid) return c;
  c.hit = hit(triangle, query, c.truth);
  const ExactCase x(triangle, query);
  c.det = exact_number(x.det);
  c.T = exact_number(x.T);
  c.w_ab = exact_number(x.w_ab);
  c.w_bc = exact_number(x.w_bc);
  c.w_ca = exact_number(x.w_ca);
  if (x.det.sign() == 0) return c;
  c.t = exact_ratio(x.t());
  c.u = exact_ratio(x.u());
  c.v = exact_ratio(x.v());
  c.range = versus_range(x.t(), query.ray);
  return c;
}

std::string explain(const Triangle& triangle, const Query& query) {
  Lines lines;
  add_vertices(lines, triangle);
  add_query(lines, query);
  add_certificate(lines, triangle, query);
  return lines.take();
}

std::string explain_triangle(const Triangle& triangle, const Query& query) {
  Lines lines;
  add_vertices(lines, triangle);
  add_certificate(lines, triangle, query);
  return lines.take();
}

std::string explain_verdict(const Triangle& triangle, const Query& query, const Answer& answer, const Contract& contract) {
  Lines lines;
  const Query searched = searched_ray(query, contract);
  const Truth truth = classify(triangle, searched);
  constexpr std::string_view duties[] = {"must hit", "must miss", "may do either"};
  add_contract(lines, contract);
  lines.add("asks", "{}", duties[static_cast<unsigned>(duty(triangle, query, truth, contract))]);
  add_answer(lines, answer);
  const VerdictKind verdict = judge(triangle, query, truth, answer, contract);
  lines.add("verdict", "{}", name(verdict));
  if (verdict == VerdictKind::false_hit || verdict == VerdictKind::false_miss) {
    if (const auto s = severity(triangle, searched, answer.outcome == Outcome::hit, contract.precision)) {
      add_severity(lines, s->length, s->ulps);
      lines.add("", "{}", condition_words(s->condition));
    }
  }
  return lines.take();
}

}  // namespace plumbline
