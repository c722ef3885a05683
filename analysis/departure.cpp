#include "analysis/departure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "case/finite.h"
#include "case/float_bits.h"
#include "oracle/classify.h"
#include "oracle/contact.h"
#include "oracle/judge.h"
#include "oracle/measure.h"
#include "oracle/offset.h"
#include "oracle/program_point.h"

namespace plumbline {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

double ulp_of(double x, Precision precision) {
  return std::ldexp(1.0, precision == Precision::binary32 ? ulp_exponent(static_cast<float>(x)) : ulp_exponent(x));
}

double largest(const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

// Whoever calls a tracer that searches the whole line keeps t > 0.
Contract as_called(Contract contract) {
  if (contract.range == RangeRule::line) contract.range = RangeRule::ray, contract.t_min = EndRule::open;
  return contract;
}

// 0 and the powers of two.
std::vector<double> shifts(Precision precision) {
  std::vector<double> list = {0};
  for (int k = 0; k <= last_power(precision); ++k) list.push_back(std::ldexp(1.0, k));
  return list;
}

// `hits` says of some rays which are hit, `ray_at` makes the one of a k.
template <class Hits, class RayAt>
double least(const std::vector<double>& k, const std::vector<Ray>& rays, Hits hits, RayAt ray_at) {
  const std::vector<bool> hit = hits(rays);
  const auto last = std::find(hit.rbegin(), hit.rend(), true);
  if (last == hit.rend()) return 0;
  const auto at = static_cast<std::size_t>(hit.rend() - last);  // the one after the last hit
  if (at == k.size()) return inf;
  double low = k[at - 1], high = k[at];
  while (high - low > 1) {
    const double middle = std::floor((low + high) / 2);
    (hits({ray_at(middle)}).front() ? low : high) = middle;
  }
  return high;
}

// Asks both sides about rays of one triangle.
class Referee {
 public:
  Referee(const Tracer& tracer, PreparedBag& bag, const Triangle& triangle)
      : bag_(bag),
        triangle_(triangle),
        contract_(as_called(tracer.info().contract)),
        keeps_positive_(tracer.info().contract.range == RangeRule::line),
        own_queries_(tracer.info().own_queries) {}

  const Triangle& triangle() const { return triangle_; }
  const Contract& contract() const { return contract_; }
  Query asked(const Ray& ray) const { return own_queries_ ? bag_.asked(ray) : Query(ray); }

  Answer answer(const Ray& ray) const {
    Answer a;
    bag_.trace({&ray, 1}, {&a, 1});
    return a;
  }

  std::vector<bool> answers(const std::vector<Ray>& rays) const {
    std::vector<Answer> said(rays.size());
    bag_.trace(rays, said);
    std::vector<bool> hits;
    for (const Answer& a : said)
      hits.push_back(a.outcome == Outcome::hit && !(keeps_positive_ && a.has_t && !(a.t > 0)));
    return hits;
  }

  std::vector<bool> duties(const std::vector<Ray>& rays) const {
    std::vector<bool> hits;
    for (const Ray& ray : rays) {
      const Query query = searched_ray(asked(ray), contract_);
      hits.push_back(duty(triangle_, query, classify(triangle_, query), contract_) == Duty::hit);
    }
    return hits;
  }

  Return truth(const Ray& ray) const {
    const Query query = asked(ray);
    const Truth t = classify(triangle_, query);
    if (crosses(t)) return t.versus_t_min > 0 ? Return::beyond : Return::start;
    return hit(triangle_, query, t).has_value() ? Return::none : Return::start;
  }

 private:
  PreparedBag& bag_;
  const Triangle& triangle_;
  const Contract contract_;
  const bool keeps_positive_, own_queries_;
};

template <class RayAt>
Need need(const Referee& referee, const std::vector<double>& k, const std::vector<Ray>& rays, RayAt ray_at) {
  return {.tracer = least(k, rays, [&](const std::vector<Ray>& r) { return referee.answers(r); }, ray_at),
          .exact = least(k, rays, [&](const std::vector<Ray>& r) { return referee.duties(r); }, ray_at)};
}

// The rays of one side of the triangle that leave one point.
class Side {
 public:
  /// `unit`: an ulp, negative to the back; `t_unit`: an ulp of the first ray's t.
  Side(const Referee& referee, const Vec3& point, double unit, double t_unit)
      : referee_(referee),
        point_(point),
        unit_(unit),
        t_unit_(t_unit),
        k_(shifts(precision())),
        origins_(moved(k_)) {}

  Departure leave(HitPoint kind, const Vec3& direction) const {
    Departure d{.point = kind, .ray = {point_, direction}};
    d.truth = referee_.truth(d.ray);
    d.hit = referee_.answers({d.ray}).front();
    d.need = {away(direction), later(direction)};
    return d;
  }

 private:
  Precision precision() const { return referee_.contract().precision; }

  std::vector<Vec3> moved(std::span<const double> k) const {
    std::vector<double> distances;
    for (const double x : k) distances.push_back(x * unit_);
    return moved_off(referee_.triangle(), point_, distances, precision());
  }

  Need away(const Vec3& direction) const {
    std::vector<Ray> rays;
    for (const Vec3& origin : origins_) rays.push_back({origin, direction});
    return need(referee_, k_, rays, [&](double k) { return Ray{moved({&k, 1}).front(), direction}; });
  }

  Need later(const Vec3& direction) const {
    if (referee_.contract().range != RangeRule::given) return {nan, nan};
    const auto ray_at = [&](double k) { return Ray{point_, direction, k * t_unit_}; };
    std::vector<Ray> rays;
    for (const double k : k_) rays.push_back(ray_at(k));
    return need(referee_, k_, rays, ray_at);
  }

  const Referee& referee_;
  const Vec3 point_;
  const double unit_, t_unit_;
  const std::vector<double> k_;
  const std::vector<Vec3> origins_;
};

template <class Real>
Vec3 exact_point(const Triangle& triangle, const Query& query) {
  const auto p = hit_point<Real>(triangle, query).value_or(std::array<Real, 3>{});
  return {p[0], p[1], p[2]};
}

}  // namespace

Departures depart(const Tracer& tracer, PreparedBag& bag, const Triangle& triangle, const Ray& ray,
                  std::span<const Vec3> directions) {
  const Referee referee(tracer, bag, triangle);
  const Precision precision = referee.contract().precision;
  const Answer answer = referee.answer(ray);
  Departures departures{.arrival = answer.outcome, .list = {}};
  if (answer.outcome != Outcome::hit) return departures;
  const Query query = referee.asked(ray);
  const auto exact = measure<double>(triangle, query);
  if (!exact) return departures;
  const double t_unit = ulp_of(exact->t, precision);

  const auto leave = [&](HitPoint kind, const Vec3& point) {
    departures.finite = departures.finite && is_finite(point);
    if (!is_finite(point)) return;
    const double unit = ulp_of(largest(point), precision);
    const Side front(referee, point, unit, t_unit), back(referee, point, -unit, t_unit);
    for (const Vec3& direction : directions) {
      const bool to_front = classify(triangle, Ray{point, direction}).det_sign > 0;
      departures.list.push_back((to_front ? front : back).leave(kind, direction));
    }
  };
  if (answer.has_t) leave(HitPoint::t, point_at(query.ray, answer.t, precision));
  if (answer.has_uv) leave(HitPoint::uv, point_at(triangle, answer.u, answer.v, precision));
  leave(HitPoint::rounded, precision == Precision::binary32 ? exact_point<float>(triangle, query)
                                                            : exact_point<double>(triangle, query));
  return departures;
}

}  // namespace plumbline
