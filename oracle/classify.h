// Where a ray meets a triangle, exactly. Total: any doubles, of which the non-finite are class invalid.
//
// Every coordinate is taken as the exact rational that it is. Formulas (DESIGN: a = A-O, e1 = B-A, e2 = C-A,
// N = e1 x e2, h = D x a): det = D.N, T = a.N, t = T/det, w_AB = e1.h, w_CA = -(e2.h), w_BC = det - w_CA - w_AB.
// Thread-safe; no global state.
#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "case/query.h"
#include "oracle/truth.h"

namespace plumbline {

/// Structure of arrays: column k holds `size` values. Order: origin x y z, direction x y z, t_min, t_max.
struct RayColumns {
  std::array<const double*, 8> column{};
  std::size_t size = 0;
};

/// Structure of arrays: a.x a.y a.z b.x ... c.z.
struct TriangleColumns {
  std::array<const double*, 9> column{};
  std::size_t size = 0;
};

Truth classify(const Triangle& triangle, const Ray& ray);

/// Of a query with a tail, the last stage's answer: about a microsecond.
Truth classify(const Triangle& triangle, const Query& query);

/// One triangle against many rays. truths.size() == rays.size().
void classify(const Triangle& triangle, std::span<const Ray> rays, std::span<Truth> truths);
void classify(const Triangle& triangle, const RayColumns& rays, std::span<Truth> truths);

/// A triangle for each ray. truths.size() == rays.size == triangles.size.
void classify(const TriangleColumns& triangles, const RayColumns& rays, std::span<Truth> truths);

}  // namespace plumbline
