#include "analysis/tracers.h"

#include <fmt/format.h>

#include "case/input_error.h"
#include "float_tracer/tracer_list.h"
#include "oracle/classify.h"
#include "oracle/measure.h"

namespace plumbline {
namespace {

class PreparedExact final : public PreparedBag {
 public:
  explicit PreparedExact(const Bag& bag) : triangles_(bag.triangles) {}

  // The nearest hit; of two at the same t, rounded, the first triangle's.
  void trace(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      Answer nearest;
      for (std::uint32_t k = 0; k < triangles_.size(); ++k) {
        if (!crosses(classify(triangles_[k], rays[i]))) continue;
        const auto at = measure<double>(triangles_[k], rays[i]);
        if (nearest.outcome == Outcome::hit && !(at->t < nearest.t)) continue;
        nearest = {.outcome = Outcome::hit, .has_t = true, .has_uv = true, .triangle = k, .t = at->t, .u = at->u, .v = at->v};
      }
      answers[i] = nearest;
    }
  }

 private:
  std::vector<Triangle> triangles_;
};

class ExactTracer final : public Tracer {
 public:
  ExactTracer()
      : Tracer({.name = "exact",
                .summary = "the oracle as a tracer: the control that is wrong nowhere",
                .source = "oracle/README.md",
                .contract = {}}) {}
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override { return std::make_unique<PreparedExact>(bag); }
};

}  // namespace

const std::vector<std::unique_ptr<Tracer>>& all_tracers() {
  static const auto tracers = [] {
    auto list = float_tracers();
    list.push_back(std::make_unique<ExactTracer>());
    return list;
  }();
  return tracers;
}

const Tracer& find_tracer(std::string_view name) {
  std::string names;
  for (const auto& tracer : all_tracers()) {
    if (tracer->info().name == name) return *tracer;
    names += (names.empty() ? "" : ", ") + tracer->info().name;
  }
  throw InputError(fmt::format("unknown tracer '{}'; this build has: {}", name, names));
}

}  // namespace plumbline
