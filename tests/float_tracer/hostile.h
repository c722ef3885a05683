// A tracer that does a deed at some rays, alone in a child, and what the others have to be answered.
#pragma once
#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include "float_tracer/isolated.h"
#include "float_tracer/kernel_tracer.h"
#include "float_tracer/moller_trumbore.h"

namespace plumbline {

using Deed = void (*)(Answer& answer);

// At a ray with t_max 7, the deed, after the answer; at a bag of two triangles, the deed instead of a bag.
inline constexpr double fatal = 7;

class HostileBag final : public PreparedBag {
 public:
  HostileBag(std::unique_ptr<PreparedBag> bag, Deed deed) : bag_(std::move(bag)), deed_(deed) {}
  Query asked(const Ray& ray) override {
    Query query = ray;
    query.ray.t_min = -1;
    return query;
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      bag_->trace(rays.subspan(i, 1), answers.subspan(i, 1));
      if (rays[i].t_max == fatal) deed_(answers[i]);
    }
  }

  std::unique_ptr<PreparedBag> bag_;
  Deed deed_;
};

class Hostile final : public Tracer {
 public:
  explicit Hostile(Deed deed, bool own_queries = false)
      : Tracer({.name = "hostile",
                .summary = "",
                .source = "",
                .contract = {},
                .own_queries = own_queries,
                .isolation = Isolation::process}),
        deed_(deed) {}
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    Answer none;
    if (bag.triangles.size() == 2) deed_(none);
    return std::make_unique<HostileBag>(kernel_.prepare(bag), deed_);
  }

 private:
  Deed deed_;
  KernelTracer<MollerTrumbore<double>> kernel_;
};

inline std::unique_ptr<Tracer> hostile(Deed deed, bool own_queries = false,
                                       std::chrono::milliseconds timeout = std::chrono::seconds(10)) {
  return isolated(std::make_unique<Hostile>(deed, own_queries), {.timeout = timeout});
}

inline const Bag one{.triangles = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}};

inline std::vector<Ray> rays_with(std::initializer_list<std::size_t> fatal_rays, std::size_t n = 40) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < n; ++i)
    rays.push_back({.origin = {0.125 * static_cast<double>(i % 64), 0.5, 5}, .direction = {0, 0, -1}, .t_max = 8});
  for (const std::size_t i : fatal_rays) rays[i].t_max = fatal;
  return rays;
}

inline bool same(const Answer& a, const Answer& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  return a.outcome == b.outcome && a.has_t == b.has_t && a.has_uv == b.has_uv && a.has_segment == b.has_segment &&
         a.triangle == b.triangle && bits(a.t) == bits(b.t) && bits(a.u) == bits(b.u) && bits(a.v) == bits(b.v);
}

inline std::vector<Answer> unharmed(const Bag& bag, std::span<const Ray> rays) {
  std::vector<Answer> answers(rays.size());
  KernelTracer<MollerTrumbore<double>>().prepare(bag)->trace(rays, answers);
  return answers;
}

// All as unharmed but for faults at these.
inline void expect_faults(PreparedBag& bag, std::span<const Ray> rays, const std::vector<std::size_t>& faults) {
  std::vector<Answer> answers(rays.size());
  bag.trace(rays, answers);
  const auto right = unharmed(one, rays);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (answers[i].outcome == Outcome::fault) {
      found.push_back(i);
    } else {
      EXPECT_TRUE(same(answers[i], right[i])) << "ray " << i;
    }
  EXPECT_EQ(found, faults);
}

inline void abort_it(Answer&) { std::abort(); }
inline void hang(Answer&) {
  volatile int i = 0;
  for (;;) i = i + 1;
}

}  // namespace plumbline
