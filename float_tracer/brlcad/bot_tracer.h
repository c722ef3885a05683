// What the BRL-CAD tracers share: the limits, and the answer.
//
// A rule of BRL-CAD is a type with
//   info()                the TracerInfo;
//   Rule(bag)             prepared to be shot at; the bag has a triangle, and only finite numbers;
//   possible()            whether librt itself could be;
//   empty()               whether every face was dropped, so that every ray misses;
//   shoot(o, d, pieces, why)  fills in the pieces of the ray inside the object, none for a miss: then `why` is told by
//                         which test, of a bag of one triangle. False: librt would never answer.
// Limits, Outcome::fault beyond them: every coordinate and the thickness is finite, and so is every side of the
// object's box (BRL-CAD takes an object for infinite where that overflows, and walks otherwise). t_min and t_max are
// not read. BRL-CAD reports where a ray enters and leaves: in and out, here those of the first piece; `passages` has
// them all. A surface's or solid's t is in; the hit between a plate's in and out is not reported, so a plate has no t.
// It reports no barycentrics.
#pragma once
#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "case/float_bits.h"
#include "float_tracer/brlcad/answer.h"
#include "float_tracer/brlcad/solid.h"
#include "float_tracer/tracer.h"

namespace plumbline::brlcad {

inline bool finite(const Vec3& v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

inline bool finite_sides(const Box& box) {
  return is_finite(box.high[0] - box.low[0]) && is_finite(box.high[1] - box.low[1]) &&
         is_finite(box.high[2] - box.low[2]);
}

inline bool finite(const Bag& bag) {
  return is_finite(bag.thickness) && std::ranges::all_of(bag.triangles, [](const Triangle& t) {
           return finite(t.a) && finite(t.b) && finite(t.c);
         });
}

template <class Rule>
class PreparedBot final : public PreparedBag {
 public:
  explicit PreparedBot(const Bag& bag)
      : possible_(finite(bag)), one_(bag.triangles.size() == 1), thin_(bag.mode != BagMode::plate) {
    if (!possible_ || bag.triangles.empty()) return;
    rule_.emplace(bag);
    possible_ = rule_->possible();
  }

  Rejection rejection(const Ray& ray) override {
    Rejection why = Rejection::none;
    if (one_) shoot(ray, &why);
    return why;
  }

  bool passages(const Ray& ray, std::vector<Passage>& passages) override {
    const bool answered = shoot(ray).outcome != Outcome::fault;
    if (answered)
      passages = pieces_;
    else
      passages.clear();
    return answered;
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = shoot(rays[i]);
  }

  template <class Why = Unasked>
  Answer shoot(const Ray& ray, Why why = {}) {
    pieces_.clear();
    if (!possible_ || !finite(ray.origin) || !finite(ray.direction)) return {.outcome = Outcome::fault};
    if (!rule_ || rule_->empty()) {
      missed_by(Rejection::face, why);
      return {};
    }
    if (!rule_->shoot(to_vec<double>(ray.origin), to_vec<double>(ray.direction), pieces_, why))
      return {.outcome = Outcome::fault};
    return answer_of(pieces_, thin_);
  }

  bool possible_, one_, thin_;
  std::optional<Rule> rule_;     // none of a bag without triangles
  std::vector<Passage> pieces_;  // of the ray that was shot last
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
