#include "oracle/sensitivity.h"

#include "oracle/exact_case.h"
#include "oracle/invalid.h"
#include "oracle/round.h"

namespace plumbline {

using namespace exact;

// The ray meets the plane in P = O + t D = w A + u B + v C. Where all five points and vectors change, the two sides part by
//   d = dO + t dD - w dA - u dB - v dC,
// and -dt D + du e1 + dv e2 = d; Cramer's rule gives
//   dt = -(N . d) / det,  du = (e2 x D) . d / det,  dv = (D x e1) . d / det,  dw = -du - dv.
// With |dx| <= eps |x| for each coordinate, |d_k| <= eps m_k, m = |O| + |t D| + |w A| + |u B| + |v C|, and all signs of d
// occur: the maximum is eps times the sum of |row_k| m_k. Times det twice, there is no division before the end.
std::optional<Sensitivity> sensitivity(const Triangle& triangle, const Query& query) {
  if (why_invalid(triangle, query.ray) != Invalid::none) return std::nullopt;
  const ExactCase x(triangle, query);
  if (x.det.sign() == 0) return std::nullopt;
  Vec m;  // times |det|
  for (std::size_t k = 0; k < 3; ++k)
    m[k] = abs(x.det * x.origin[k]) + abs(x.T * x.direction[k]) + abs(x.w_bc * x.a[k]) + abs(x.w_ca * x.b[k]) +
           abs(x.w_ab * x.c[k]);
  const Dyadic det2 = square(x.det);
  const auto sum = [&](const Vec& row) {
    return rounded<double>({abs(row[0]) * m[0] + abs(row[1]) * m[1] + abs(row[2]) * m[2], det2});
  };
  const Vec of_u = cross(x.e2, x.direction), of_v = cross(x.direction, x.e1);
  return Sensitivity{.t = sum(x.normal), .u = sum(of_u), .v = sum(of_v), .w = sum(of_u + of_v)};
}

}  // namespace plumbline
