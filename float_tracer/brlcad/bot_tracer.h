// What the BRL-CAD tracers share: one face per bag, two ways to shoot at it, and the answer.
//
// A rule of BRL-CAD is a type with
//   info()                    the TracerInfo;
//   shoot(solid, o, d, why)   std::optional<Segment>, empty for a miss: then `why` is told by which test.
// Limits, Outcome::fault beyond them: a bag has exactly one triangle (what several do to each other is not modelled),
// every coordinate and the thickness is finite, and so is every side of the triangle's box (BRL-CAD takes an object for
// infinite where that overflows, and walks otherwise). t_min and t_max are not read. BRL-CAD reports where a ray enters
// and leaves: in and out. A surface's or solid's t is in (= out); the hit between a plate's in and out is not reported,
// so a plate has no t. It reports no barycentrics.
#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>

#include "case/float_bits.h"
#include "float_tracer/brlcad/segment.h"
#include "float_tracer/brlcad/walk.h"
#include "float_tracer/tracer.h"

namespace plumbline::brlcad {

inline bool finite(const Vec3& v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

inline bool within_limits(const Bag& bag) {
  if (bag.triangles.size() != 1 || !is_finite(bag.thickness)) return false;
  const auto& [a, b, c] = bag.triangles.front();
  const auto side = [](double x, double y, double z) { return std::max({x, y, z}) - std::min({x, y, z}); };
  return finite(a) && finite(b) && finite(c) && finite({side(a.x, b.x, c.x), side(a.y, b.y, c.y), side(a.z, b.z, c.z)});
}

/// Shoots through the walk: `test(solid, entry)` gives the parameter of the hit as seen from the moved origin, if any,
/// and tells `why`.
template <class Why, class Test>
std::optional<Segment> shoot_model(const Solid& solid, const Vector& origin, const Vector& direction, Why why,
                                   Test test) {
  const std::optional<Entry> entry = enter(solid.model_box, origin, direction, why);
  if (!entry) return std::nullopt;
  const std::optional<double> t = test(solid, *entry);
  if (!t) return std::nullopt;
  const std::optional<Segment> segment = segment_at(solid, entry->direction, *t);
  if (!segment) return missed_by(Rejection::segment, why);
  const std::optional<Segment> woven = weave({segment->in + entry->moved, segment->out + entry->moved});
  if (!woven) missed_by(Rejection::t, why);
  return woven;
}

template <class Rule>
class PreparedBot final : public PreparedBag {
 public:
  explicit PreparedBot(const Bag& bag) : possible_(within_limits(bag)) {
    if (possible_) solid_ = prepare_solid(bag);
  }

  Rejection rejection(const Ray& ray) override {
    Rejection why = Rejection::none;
    shoot(ray, &why);
    return why;
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = shoot(rays[i]);
  }

  template <class Why = Unasked>
  Answer shoot(const Ray& ray, Why why = {}) const {
    if (!possible_ || !finite(ray.origin) || !finite(ray.direction)) return {.outcome = Outcome::fault};
    if (!solid_) {
      missed_by(Rejection::face, why);
      return {};
    }
    const auto segment = Rule::shoot(*solid_, to_vec<double>(ray.origin), to_vec<double>(ray.direction), why);
    if (!segment) return {};
    Answer answer{.outcome = Outcome::hit, .has_segment = true, .in = segment->in, .out = segment->out};
    if (solid_->mode != BagMode::plate) {
      answer.has_t = true;
      answer.t = segment->in;
    }
    return answer;
  }

  bool possible_;
  std::optional<Solid> solid_;  // empty: the face was dropped, and every ray misses
};

template <class Rule>
class BotTracer final : public Tracer {
 public:
  BotTracer() : Tracer(Rule::info()) {}
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<PreparedBot<Rule>>(bag);
  }
};

}  // namespace plumbline::brlcad
