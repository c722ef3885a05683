// A tracer that is right, but for a planted fault.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "float_tracer/tracer.h"
#include "oracle/bag/bag_truth.h"

namespace plumbline {

struct Met {
  std::uint32_t triangle;
  Truth truth;
  double t;
};

/// What the fault does to the triangles that the ray meets, in their exact order. `bag` is how many there
/// are in all.
using Fault = std::function<void(std::vector<Met>& met, std::size_t bag)>;

class Faulty final : public Tracer {
 public:
  explicit Faulty(Fault fault, const Contract& contract = {})
      : Tracer({.name = "faulty", .summary = "", .source = "", .contract = contract}), fault_(std::move(fault)) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    struct Prepared final : PreparedBag {
      Prepared(const Bag& b, const Fault& f) : bag(b), fault(f) {}
      void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
          std::vector<Met> met;
          for (const BagHit& hit : bag_truth(bag.triangles, rays[i]).hits)
            met.push_back({hit.triangle, hit.truth, hit.t});
          fault(met, bag.triangles.size());
          if (met.empty()) continue;
          answers[i] = {.outcome = Outcome::hit, .has_t = true, .triangle = met[0].triangle, .t = met[0].t};
        }
      }
      Bag bag;
      const Fault& fault;
    };
    return std::make_unique<Prepared>(bag, fault_);
  }

 private:
  Fault fault_;
};

}  // namespace plumbline
