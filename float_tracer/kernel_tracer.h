// Makes a tracer of a ray/triangle kernel (see kernel.h): the loop of many rays over the triangles of one bag.
//
// The nearest hit is the answer; of several at the same t, the first triangle's. The mode of the bag is not read: every
// triangle counts as a surface. Bags and rays are converted to the kernel's precision, exactly if they hold only such
// numbers (see at_precision). Nothing is allocated and no virtual function is called per ray.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "float_tracer/kernel.h"
#include "float_tracer/tracer.h"

namespace plumbline {

template <class Kernel>
class PreparedKernelBag final : public PreparedBag {
  using Real = typename Kernel::Scalar;

 public:
  explicit PreparedKernelBag(const Bag& bag) {
    triangles_.reserve(bag.triangles.size());
    for (const Triangle& t : bag.triangles)
      triangles_.emplace_back(KernelTriangle<Real>{to_vec<Real>(t.a), to_vec<Real>(t.b), to_vec<Real>(t.c)});
  }

  Rejection rejection(const Ray& ray) override {
    Answer unread;
    Rejection why = Rejection::none;
    if (triangles_.size() == 1) answer_of(triangles_.front(), {&ray, 1}, {&unread, 1}, &why);
    return why;
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    if (triangles_.size() == 1) return answer_of(triangles_.front(), rays, answers);
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = nearest(rays[i]);
  }

  // One triangle, the commonest bag: nothing is compared. Flat, that is with the kernel inlined: an optional returned
  // through memory is read in other pieces than it was written in, and the processor waits for it, which takes longer
  // than the kernel. The triangle is a copy that no answer can overlap, so that the compiler loads and arranges it
  // once; a hit and a miss are written by stores of their own, not by a choice between two answers. Not inlined, so
  // that it's the same loop whether or not it is asked why: in variants/ the compiler may reorder sums, and does so by
  // what is around them.
  template <class Why = Unasked>
  [[gnu::flatten, gnu::noinline]] static void answer_of(const typename Kernel::PreparedTriangle triangle,
                                                        std::span<const Ray> rays, std::span<Answer> answers,
                                                        Why why = {}) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (const auto hit = Kernel::intersect(triangle, prepare(rays[i]), why)) {
        answers[i] = to_answer(*hit, 0);
      } else {
        answers[i] = {};
      }
    }
  }

  static typename Kernel::PreparedRay prepare(const Ray& r) {
    return typename Kernel::PreparedRay(KernelRay<Real>{to_vec<Real>(r.origin), to_vec<Real>(r.direction),
                                                        static_cast<Real>(r.t_min), static_cast<Real>(r.t_max)});
  }

  static Answer to_answer(const KernelHit<Real>& hit, std::uint32_t triangle) {
    return {.outcome = Outcome::hit,
            .has_t = true,
            .has_uv = true,
            .triangle = triangle,
            .t = hit.t,
            .u = hit.u,
            .v = hit.v};
  }

  // Not adapters/nearest.h: an Answer of each triangle would go through memory, as above.
  Answer nearest(const Ray& r) const {
    const typename Kernel::PreparedRay ray = prepare(r);
    std::optional<KernelHit<Real>> best;
    std::uint32_t triangle = 0;
    for (std::uint32_t k = 0; k < triangles_.size(); ++k) {
      const std::optional<KernelHit<Real>> hit = Kernel::intersect(triangles_[k], ray);
      if (!hit || (best && !(hit->t < best->t))) continue;
      best = hit;
      triangle = k;
    }
    return best ? to_answer(*best, triangle) : Answer{};
  }

  std::vector<typename Kernel::PreparedTriangle> triangles_;
};

/// The kernel's own promise, `static constexpr Contract contract`, if it has one; else what all the textbook kernels
/// declare: two-sided, closed edges, closed range, no widening. The precision is always that of its Scalar.
template <class Kernel>
constexpr Contract contract_of() {
  Contract contract;
  if constexpr (requires { Kernel::contract; }) contract = Kernel::contract;
  contract.precision = std::is_same_v<typename Kernel::Scalar, float> ? Precision::binary32 : Precision::binary64;
  return contract;
}

/// The tracer NAME_f32 or NAME_f64.
template <class Kernel>
class KernelTracer final : public Tracer {
  static constexpr Contract contract = contract_of<Kernel>();

 public:
  KernelTracer()
      : Tracer({.name = std::string(Kernel::name) + (contract.precision == Precision::binary32 ? "_f32" : "_f64"),
                .summary = std::string(Kernel::summary),
                .source = std::string(Kernel::source),
                .contract = contract}) {}

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<PreparedKernelBag<Kernel>>(bag);
  }
};

}  // namespace plumbline
