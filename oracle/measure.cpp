#include "oracle/measure.h"

#include "oracle/exact_case.h"
#include "oracle/integer_case.h"
#include "oracle/invalid.h"
#include "oracle/quotient.h"
#include "oracle/round.h"

namespace plumbline {
namespace {

std::optional<exact::ExactCase> crossing(const Triangle& triangle, const Query& query) {
  if (why_invalid(triangle, query.ray) != Invalid::none) return std::nullopt;
  exact::ExactCase x(triangle, query);
  if (x.det.sign() == 0) return std::nullopt;
  return x;
}

// Any case, with GMP.
template <class Real>
[[gnu::noinline]] std::optional<Coordinates<Real>> measure_any(const Triangle& triangle, const Query& query) {
  const auto x = crossing(triangle, query);
  if (!x) return std::nullopt;
  return Coordinates<Real>{exact::rounded<Real>(x->t()), exact::rounded<Real>(x->u()), exact::rounded<Real>(x->v())};
}

}  // namespace

template <class Real>
std::optional<Coordinates<Real>> measure(const Triangle& triangle, const Query& query) {
  if (query.has_tail()) return measure_any<Real>(triangle, query);
  const Ray& ray = query.ray;
  const auto x = IntegerCase::make(triangle, ray);
  if (!x || is_nan(ray.t_min) || is_nan(ray.t_max)) return measure_any<Real>(triangle, query);
  const IntegerDeterminants k(*x);
  if (k.det.sign() == 0) return std::nullopt;
  const auto t = rounded_quotient<Real>(k.T, k.det, x->point_unit - x->direction_unit);
  const auto u = rounded_quotient<Real>(k.w_ca, k.det, 0), v = rounded_quotient<Real>(k.w_ab, k.det, 0);
  if (!t || !u || !v) return measure_any<Real>(triangle, query);
  return Coordinates<Real>{*t, *u, *v};
}

template std::optional<Coordinates<float>> measure<float>(const Triangle&, const Query&);
template std::optional<Coordinates<double>> measure<double>(const Triangle&, const Query&);

template <class Real>
std::optional<std::array<Real, 3>> hit_point(const Triangle& triangle, const Query& query) {
  const auto x = crossing(triangle, query);
  if (!x) return std::nullopt;
  std::array<Real, 3> point;
  for (std::size_t k = 0; k < 3; ++k)
    point[k] = exact::rounded<Real>({x->origin[k] * x->det + x->T * x->direction[k], x->det});
  return point;
}

template std::optional<std::array<float, 3>> hit_point<float>(const Triangle&, const Query&);
template std::optional<std::array<double, 3>> hit_point<double>(const Triangle&, const Query&);

std::optional<std::string> exact_t(const Triangle& triangle, const Query& query) {
  const auto x = crossing(triangle, query);
  if (!x) return std::nullopt;
  const mpq_class t = to_mpq(x->t());
  return t.get_num().get_str() + "/" + t.get_den().get_str();
}

}  // namespace plumbline
