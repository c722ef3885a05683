#include "oracle/classify.h"

#include "case/float_bits.h"
#include "oracle/exact_case.h"

namespace plumbline {
namespace {

using exact::Dyadic;
using exact::ExactCase;

// sign of t - bound: of (T - bound * det) * det, without division.
signed char versus(const ExactCase& x, double bound) {
  if (!is_finite(bound)) return is_negative(bound) ? 1 : -1;
  return static_cast<signed char>((x.T - Dyadic(bound) * x.det).sign() * x.det.sign());
}

void classify_crossing(const ExactCase& x, Truth& truth) {
  const int det = x.det.sign();
  const int ab = x.w_ab.sign() * det, bc = x.w_bc.sign() * det, ca = x.w_ca.sign() * det;
  if (ab < 0 || bc < 0 || ca < 0) {
    truth.hit_class = HitClass::exterior;
    return;
  }
  // A zero w puts the line on that edge; two, on the vertex between. Three would make det zero.
  constexpr Feature features[8] = {Feature::none, Feature::ab, Feature::bc, Feature::b,
                                   Feature::ca,   Feature::a,  Feature::c,  Feature::none};
  truth.feature = features[(ab == 0 ? 1 : 0) | (bc == 0 ? 2 : 0) | (ca == 0 ? 4 : 0)];
  truth.hit_class = truth.feature == Feature::none  ? HitClass::interior
                    : truth.feature < Feature::a ? HitClass::edge
                                                 : HitClass::vertex;
}

}  // namespace

Truth classify(const Triangle& triangle, const Ray& ray) {
  Truth truth;
  truth.invalid = exact::why_invalid(triangle, ray);
  if (truth.invalid != Invalid::none) return truth;
  const ExactCase x(triangle, ray);
  truth.det_sign = static_cast<signed char>(x.det.sign());
  if (truth.det_sign != 0) {
    classify_crossing(x, truth);
    truth.versus_t_min = versus(x, ray.t_min);
    truth.versus_t_max = versus(x, ray.t_max);
    return truth;
  }
  truth.hit_class = is_zero(x.normal)  ? HitClass::degenerate
                    : x.T.sign() == 0 ? HitClass::coplanar
                                      : HitClass::parallel;
  truth.touches = exact::contact_in_range(x, ray).has_value();
  return truth;
}

void classify(const Triangle& triangle, std::span<const Ray> rays, std::span<Truth> truths) {
  for (std::size_t i = 0; i < rays.size(); ++i) truths[i] = classify(triangle, rays[i]);
}

namespace {

Ray row(const RayColumns& rays, std::size_t i) {
  const auto& c = rays.column;
  return {{c[0][i], c[1][i], c[2][i]}, {c[3][i], c[4][i], c[5][i]}, c[6][i], c[7][i]};
}

Triangle row(const TriangleColumns& triangles, std::size_t i) {
  const auto& c = triangles.column;
  return {{c[0][i], c[1][i], c[2][i]}, {c[3][i], c[4][i], c[5][i]}, {c[6][i], c[7][i], c[8][i]}};
}

}  // namespace

void classify(const Triangle& triangle, const RayColumns& rays, std::span<Truth> truths) {
  for (std::size_t i = 0; i < rays.size; ++i) truths[i] = classify(triangle, row(rays, i));
}

void classify(const TriangleColumns& triangles, const RayColumns& rays, std::span<Truth> truths) {
  for (std::size_t i = 0; i < rays.size; ++i) truths[i] = classify(row(triangles, i), row(rays, i));
}

}  // namespace plumbline
