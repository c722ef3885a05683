#include "oracle/bag/owner.h"

#include "oracle/exact_case.h"

namespace plumbline {
namespace {

// w_PQ = D . ((P-O) x (Q-O)) is 0; turned aside, it has the sign of the first component that isn't.
int sign_aside(const exact::Vec& p, const exact::Vec& q) {
  for (const exact::Dyadic& component : exact::cross(p, q))
    if (component.sign() != 0) return component.sign();
  return 0;
}

}  // namespace

bool owns(const Triangle& triangle, const Query& query, const Truth& truth) {
  if (truth.feature == Feature::none) return true;
  const exact::Vec o = exact::to_exact(query.ray.origin);
  const exact::Vec a = exact::to_exact(triangle.a) - o, b = exact::to_exact(triangle.b) - o,
                   c = exact::to_exact(triangle.c) - o;
  const Feature at = truth.feature;
  const bool on_ab = at == Feature::ab || at == Feature::a || at == Feature::b;
  const bool on_bc = at == Feature::bc || at == Feature::b || at == Feature::c;
  const bool on_ca = at == Feature::ca || at == Feature::c || at == Feature::a;
  const int inner = truth.det_sign;  // the sign of every w of a ray that crosses inside
  return (!on_ab || sign_aside(a, b) == inner) && (!on_bc || sign_aside(b, c) == inner) &&
         (!on_ca || sign_aside(c, a) == inner);
}

}  // namespace plumbline
