// A tracer that answers as a test says, whatever it is asked.
#pragma once
#include <cfenv>
#include <functional>

#include "float_tracer/tracer.h"

namespace plumbline {

struct FixedAnswer {
  Answer answer;
  Rejection rejection = Rejection::none;
  Conduct conduct = {};
  int raised = 0;  ///< exceptions of <cfenv>
  std::function<Query(const Ray&)> asked = [](const Ray& ray) { return Query(ray); };
};

class FixedTracer final : public Tracer {
 public:
  explicit FixedTracer(FixedAnswer fixed, const Contract& contract = {})
      : Tracer({.name = "fixed", .summary = "", .source = "", .contract = contract}), fixed_(std::move(fixed)) {}

  std::unique_ptr<PreparedBag> prepare(const Bag&) const override {
    struct Prepared final : PreparedBag {
      explicit Prepared(const FixedAnswer& f) : fixed(f) {}
      Query asked(const Ray& ray) override { return fixed.asked(ray); }
      Rejection rejection(const Ray&) override { return fixed.rejection; }
      void answer(std::span<const Ray>, std::span<Answer> answers) override {
        for (Answer& a : answers) a = fixed.answer;
        conduct_ = fixed.conduct;
        std::feraiseexcept(fixed.raised);
      }
      const FixedAnswer& fixed;
    };
    return std::make_unique<Prepared>(fixed_);
  }

 private:
  FixedAnswer fixed_;
};

inline constexpr Answer a_miss = {};
inline constexpr Answer a_hit = {.outcome = Outcome::hit};
inline constexpr Answer hit_at(double t) { return {.outcome = Outcome::hit, .has_t = true, .t = t}; }
inline constexpr Answer hit_at(double t, double u, double v) {
  return {.outcome = Outcome::hit, .has_t = true, .has_uv = true, .t = t, .u = u, .v = v};
}

}  // namespace plumbline
