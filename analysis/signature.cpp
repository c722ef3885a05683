#include "analysis/signature.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "case/float_bits.h"

namespace plumbline {
namespace {

bool finite_numbers(const Answer& answer) {
  return (!answer.has_t || is_finite(answer.t)) && (!answer.has_uv || (is_finite(answer.u) && is_finite(answer.v)));
}

double displaced_by(const Examination& e) { return std::max(e.displacement, e.residual); }

bool displaced(const Examination& e) {
  if (!e.margins) return false;
  const Margins& m = *e.margins;
  const Coordinates<double> limit = leeway(m, e.precision);
  return e.residual * m.ulp > limit.t * m.t_scale || e.displacement * m.ulp > limit.u * m.u_scale;
}

std::optional<FindingKind> kind(const Examination& e) {
  if (e.died) return FindingKind::death;
  switch (e.verdict) {
    case VerdictKind::false_miss: return FindingKind::false_miss;
    case VerdictKind::false_hit: return FindingKind::false_hit;
    case VerdictKind::correct:
      if (e.answer.outcome != Outcome::hit) return std::nullopt;
      if (!finite_numbers(e.answer)) return FindingKind::not_finite;
      if (displaced(e)) return FindingKind::displaced;
      return std::nullopt;
    case VerdictKind::unspecified:
    case VerdictKind::fault:
    case VerdictKind::leak:
    case VerdictKind::wrong_nearest: break;
  }
  return std::nullopt;
}

// Beyond which edges, or which vertex, the line passes.
Element passed(const Margins& m) {
  const bool ab = m.ab < 0, bc = m.bc < 0, ca = m.ca < 0;
  if (ab && ca) return Element::a;
  if (ab && bc) return Element::b;
  if (bc && ca) return Element::c;
  return ab ? Element::ab : bc ? Element::bc : ca ? Element::ca : Element::none;
}

Element passed(const Examination& e) {
  if (e.truth.det_sign == 0) return Element::plane;
  if (const Element edge = passed(*e.margins); edge != Element::none) return edge;
  return e.truth.versus_t_min < 0 ? Element::t_min : e.truth.versus_t_max > 0 ? Element::t_max : Element::none;
}

Element of(Feature feature) {
  switch (feature) {
    case Feature::ab: return Element::ab;
    case Feature::bc: return Element::bc;
    case Feature::ca: return Element::ca;
    case Feature::a: return Element::a;
    case Feature::b: return Element::b;
    case Feature::c: return Element::c;
    case Feature::none: break;
  }
  return Element::none;
}

// How a hit is nearest to being a miss.
Element nearest(const Examination& e) {
  if (e.truth.feature != Feature::none) return of(e.truth.feature);
  if (e.truth.versus_t_min == 0) return Element::t_min;
  if (e.truth.versus_t_max == 0) return Element::t_max;
  const Margins& m = *e.margins;
  struct Exit {
    double depth;
    Element element;
  };
  std::array<Exit, 5> exits = {{{m.v * m.v_scale, Element::ab},
                                {m.w * m.w_scale, Element::bc},
                                {m.u * m.u_scale, Element::ca},
                                {(m.t - e.query.ray.t_min) * m.t_scale, Element::t_min},
                                {(e.query.ray.t_max - m.t) * m.t_scale, Element::t_max}}};
  return std::ranges::min_element(exits, {}, &Exit::depth)->element;
}

bool on_boundary(const Truth& truth) {
  return crosses(truth) && (truth.hit_class != HitClass::interior || truth.versus_t_min == 0 || truth.versus_t_max == 0);
}

}  // namespace

std::pair<Conditioning, unsigned char> conditioning(const Examination& e) {
  const Margins& m = *e.margins;
  constexpr std::array<double, 4> limits = {0x1p-5, 0x1p-10, 0x1p-20, 0x1p-40};
  const double least = std::min({m.sine, m.altitude, m.size});
  const auto bucket = static_cast<unsigned char>(std::ranges::count_if(limits, [least](double l) { return least < l; }));
  if (e.out_of_range) return {Conditioning::range, bucket};
  if (e.nominal()) return {Conditioning::nominal, bucket};
  if (m.condition().nominal()) return {Conditioning::far, bucket};
  return {least == m.sine ? Conditioning::grazing : least == m.altitude ? Conditioning::sliver : Conditioning::far, bucket};
}

std::uint32_t Signature::key() const {
  std::uint32_t k = static_cast<unsigned>(kind);
  const auto add = [&k](unsigned value, unsigned bits) { k = k << bits | value; };
  add(static_cast<unsigned>(element), 4);
  add(static_cast<unsigned>(rejection), 4);
  add(boundary, 1);
  add(static_cast<unsigned>(conditioning), 3);
  add(bucket, 3);
  add(lucky, 1);
  return k;
}

std::optional<Signature> signature(const Examination& e, Wish wish) {
  const auto found = kind(e);
  if (!found) return std::nullopt;
  Signature s;
  s.kind = *found;
  s.rejection = e.rejection;
  s.lucky = e.wrong() && wish == (e.answer.outcome == Outcome::hit ? Wish::hit : Wish::miss);
  if (!e.margins) {  // no condition numbers: they would be 0
    if (e.truth.hit_class == HitClass::degenerate) s.conditioning = Conditioning::sliver, s.bucket = 4;
    if (e.truth.hit_class == HitClass::coplanar) s.conditioning = Conditioning::grazing, s.bucket = 4;
    return s;
  }
  std::tie(s.conditioning, s.bucket) = conditioning(e);
  s.boundary = e.wrong() && on_boundary(e.truth);
  if (s.kind == FindingKind::false_hit) s.element = passed(e);
  if (s.kind == FindingKind::false_miss) s.element = nearest(e);
  if (s.kind == FindingKind::displaced && e.residual > e.displacement) s.element = Element::plane;
  return s;
}

Coordinates<double> leeway(const Margins& m, Precision precision) {
  const bool binary32 = precision == Precision::binary32;
  const double length = m.size * m.ulp * (binary32 ? 0x1p14 : 0x1p43);  // in ulps the longest edge is size * 2^digits at most
  const double rounding = std::abs(m.t) * (binary32 ? 0x1p-22 : 0x1p-39);
  return {std::max(length / m.t_scale, rounding), length / m.u_scale, length / m.v_scale};
}

double finding_ulps(const Examination& e, const Signature& found) {
  return found.kind == FindingKind::displaced ? displaced_by(e) : e.severity_ulps();
}

std::string to_word(const Signature& s) {
  std::string word(name(s.kind));
  const auto add = [&word](std::string_view part) { (word += '-') += part; };
  if (s.element != Element::none) add(name(s.element));
  if (s.rejection != Rejection::none) add("by"), add(name(s.rejection));
  if (s.boundary) add("exactly");
  add(name(s.conditioning));
  add("c" + std::to_string(s.bucket));
  if (s.lucky) add("lucky");
  return word;
}

}  // namespace plumbline
