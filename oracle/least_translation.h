// The geometry of severity.h, written once for exact and for rounded numbers. Private to the oracle.
//
// Numbers names the kind: Vec, vectors between points; Normal, their cross products; Height, a scalar; and
//   Normal cross(Vec, Vec), bool is_zero(Normal)
//   int sign_of_dot(Vec, Vec), sign_of_dot(Normal, Normal): exact for both kinds, so that every candidate
//     offered is the distance of a pair of points that are really there
//   Measure length(Vec), ratio(Height, Normal), ratio(Normal, Vec): |x|, |x| / |y|, or what grows with them
#pragma once
#include <array>
#include <cstddef>
#include <optional>

namespace plumbline {

/// A line and a triangle, seen from a point O of the line; edges AB, BC, CA.
template <class Numbers>
struct Sight {
  typename Numbers::Vec direction;
  std::array<typename Numbers::Vec, 3> to;         ///< A-O, B-O, C-O
  std::array<typename Numbers::Vec, 3> edge;       ///< B-A, C-B, A-C
  typename Numbers::Normal normal;                 ///< (B-A) x (C-A)
  std::array<typename Numbers::Normal, 3> across;  ///< edge x D
  std::array<typename Numbers::Height, 3> w;       ///< w_AB, w_BC, w_CA
};

/// The end of a ray, at t = tau.
template <class Numbers>
struct RayEnd {
  std::array<typename Numbers::Vec, 3> to;  ///< from it to A, B, C
  typename Numbers::Height height;          ///< T - tau det
};

template <class Numbers>
class Least {
 public:
  using Measure = typename Numbers::Measure;
  bool would_take(const Measure& x) const { return !least_ || x < *least_; }
  void offer(const Measure& x) {
    if (would_take(x)) least_ = x;
  }
  const Measure& get() const { return *least_; }

 private:
  std::optional<Measure> least_;
};

/// Truth hit: how far to the nearest exit, over an edge line or past an end of the range (null: it has none
/// there).
template <class Numbers>
typename Numbers::Measure depth(const Sight<Numbers>& x, const RayEnd<Numbers>* low,
                                const RayEnd<Numbers>* high) {
  Least<Numbers> least;
  for (std::size_t k = 0; k < 3; ++k) least.offer(Numbers::ratio(x.w[k], x.across[k]));
  for (const auto* end : {low, high})
    if (end != nullptr) least.offer(Numbers::ratio(end->height, x.normal));
  return least.get();
}

template <class Numbers>
void offer_end_to_triangle(Least<Numbers>& least, const Sight<Numbers>& x, const RayEnd<Numbers>& end) {
  const auto height = Numbers::ratio(end.height, x.normal);
  if (!least.would_take(height)) return;  // no point of the triangle is nearer to the end than its plane
  bool over_interior = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &to_p = end.to[k], &to_q = end.to[(k + 1) % 3], &edge = x.edge[k];
    const auto moment = Numbers::cross(to_p, edge);
    least.offer(Numbers::length(to_p));
    if (Numbers::sign_of_dot(to_p, edge) <= 0 && Numbers::sign_of_dot(to_q, edge) >= 0)
      least.offer(Numbers::ratio(moment, edge));
    over_interior = over_interior && Numbers::sign_of_dot(x.normal, moment) >= 0;
  }
  if (over_interior) least.offer(height);
}

/// Truth miss: the distance between the ray and the closed triangle, which do not meet. It is attained between
/// two features that do not cross: the ray and a vertex, the ray and an edge, or an end of the ray and the
/// triangle.
template <class Numbers>
typename Numbers::Measure distance(const Sight<Numbers>& x, const RayEnd<Numbers>* low,
                                   const RayEnd<Numbers>* high) {
  Least<Numbers> least;
  const std::array<typename Numbers::Normal, 3> moment = {Numbers::cross(x.to[0], x.direction),
                                                          Numbers::cross(x.to[1], x.direction),
                                                          Numbers::cross(x.to[2], x.direction)};
  for (std::size_t k = 0; k < 3; ++k) {
    if (low != nullptr && Numbers::sign_of_dot(low->to[k], x.direction) < 0) continue;
    if (high != nullptr && Numbers::sign_of_dot(high->to[k], x.direction) > 0) continue;
    least.offer(Numbers::ratio(moment[k], x.direction));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& across = x.across[k];
    if (Numbers::is_zero(across)) continue;  // parallel lines: attained at a vertex or an end as well
    if (Numbers::sign_of_dot(moment[k], across) > 0 || Numbers::sign_of_dot(moment[(k + 1) % 3], across) < 0)
      continue;
    if (low != nullptr && Numbers::sign_of_dot(Numbers::cross(low->to[k], x.edge[k]), across) > 0) continue;
    if (high != nullptr && Numbers::sign_of_dot(Numbers::cross(high->to[k], x.edge[k]), across) < 0) continue;
    least.offer(Numbers::ratio(x.w[k], across));
  }
  for (const auto* end : {low, high})
    if (end != nullptr) offer_end_to_triangle(least, x, *end);
  return least.get();
}

}  // namespace plumbline
