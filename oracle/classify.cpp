#include "oracle/classify.h"

#include <algorithm>
#include <bit>

#include "oracle/accumulator.h"
#include "oracle/batch.h"
#include "oracle/batch_kernel.h"
#include "oracle/invalid.h"

namespace plumbline {
namespace {

std::array<const double*, 9> columns(const Triangle& t) {
  return {&t.a.x, &t.a.y, &t.a.z, &t.b.x, &t.b.y, &t.b.z, &t.c.x, &t.c.y, &t.c.z};
}

}  // namespace

Truth classify(const Triangle& triangle, const Ray& ray) {
  using Filter = BatchKernel<1>;
  const auto vec = [](const Vec3& v) { return Filter::RealVec{v.x, v.y, v.z}; };
  const Filter::Cases one = {vec(ray.origin), vec(ray.direction), vec(triangle.a), vec(triangle.b), vec(triangle.c),
                             ray.t_min,       ray.t_max};
  Lanes<1>::Word truth;
  if (Filter::filter(one, truth)) return std::bit_cast<Truth>(truth);
  StageCounts counts;
  return classify_scalar(triangle, ray, std::bit_cast<KnownSigns>(Filter::known_signs(one)), counts);
}

Truth classify(const Triangle& triangle, const Query& query) {
  if (!query.has_tail()) return classify(triangle, query.ray);
  const Invalid reason = why_invalid(triangle, query.ray);
  return reason == Invalid::none ? classify_accumulate(triangle, query) : Truth{.invalid = reason};
}

void classify(const Triangle& triangle, std::span<const Ray> rays, std::span<Truth> truths) {
  double column[8][lane_block];
  Batch batch{.triangle = columns(triangle), .one_triangle = true};
  for (std::size_t k = 0; k < 8; ++k) batch.ray[k] = column[k];
  for (std::size_t first = 0; first < rays.size(); first += lane_block) {
    batch.size = std::min<std::size_t>(lane_block, rays.size() - first);
    batch.truths = truths.data() + first;
    for (std::size_t i = 0; i < batch.size; ++i) {
      const Ray& r = rays[first + i];
      const double row[8] = {r.origin.x,    r.origin.y,    r.origin.z, r.direction.x,
                             r.direction.y, r.direction.z, r.t_min,    r.t_max};
      for (std::size_t k = 0; k < 8; ++k) column[k][i] = row[k];
    }
    classify(batch, best_isa(), nullptr);
  }
}

void classify(const Triangle& triangle, const RayColumns& rays, std::span<Truth> truths) {
  classify({.triangle = columns(triangle), .ray = rays.column, .size = rays.size, .one_triangle = true, .truths = truths.data()},
           best_isa(), nullptr);
}

void classify(const TriangleColumns& triangles, const RayColumns& rays, std::span<Truth> truths) {
  classify({.triangle = triangles.column, .ray = rays.column, .size = rays.size, .truths = truths.data()}, best_isa(), nullptr);
}

}  // namespace plumbline
