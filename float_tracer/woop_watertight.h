// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", Journal of Computer Graphics Techniques 2(1), 2013:
// moves the origin to 0, shears the ray onto the axis of its largest component and tests the projected triangle in the
// plane, so that two triangles that share an edge compute the same number for it.
//
// The paper's two-sided test. In binary32, where an edge function comes out as exactly zero all three are computed
// again in binary64, where the products are exact; the paper names no such step for binary64, so there the zeros stand.
// The paper's swap of two axes to keep the winding serves only culling and is left out: it negates every number here.
#pragma once
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>

#include "float_tracer/kernel.h"

namespace plumbline::inline PLUMBLINE_KERNELS {

template <class Real>
struct WoopWatertight {
  using Scalar = Real;
  static constexpr std::string_view name = "woop_watertight";
  static constexpr std::string_view summary = "sheared edge functions, watertight along shared edges, two-sided";
  static constexpr std::string_view source =
      "Woop, Benthin and Wald, Watertight Ray/Triangle Intersection, JCGT 2(1), 2013";

  using PreparedTriangle = KernelTriangle<Real>;

  struct PreparedRay {
    explicit PreparedRay(const KernelRay<Real>& r)
        : ray(r), kz(largest_axis(r.direction)), kx(next_axis(kz)), ky(next_axis(kx)) {
      sx = r.direction[kx] / r.direction[kz];
      sy = r.direction[ky] / r.direction[kz];
      sz = 1 / r.direction[kz];
    }
    KernelRay<Real> ray;
    int kz, kx, ky;
    Real sx, sy, sz;
  };

  template <class Why = Unasked>
  static std::optional<KernelHit<Real>> intersect(const PreparedTriangle& triangle, const PreparedRay& r,
                                                  Why why = {}) {
    const Vec<Real> a = triangle.a - r.ray.origin, b = triangle.b - r.ray.origin, c = triangle.c - r.ray.origin;
    const Real ax = a[r.kx] - r.sx * a[r.kz], ay = a[r.ky] - r.sy * a[r.kz];
    const Real bx = b[r.kx] - r.sx * b[r.kz], by = b[r.ky] - r.sy * b[r.kz];
    const Real cx = c[r.kx] - r.sx * c[r.kz], cy = c[r.ky] - r.sy * c[r.kz];

    Real wa = edge_function<Real>(cx, cy, bx, by);
    Real wb = edge_function<Real>(ax, ay, cx, cy);
    Real wc = edge_function<Real>(bx, by, ax, ay);
    if constexpr (std::is_same_v<Real, float>) {
      if (wa == 0 || wb == 0 || wc == 0) {
        wa = static_cast<float>(edge_function<double>(cx, cy, bx, by));
        wb = static_cast<float>(edge_function<double>(ax, ay, cx, cy));
        wc = static_cast<float>(edge_function<double>(bx, by, ax, ay));
      }
    }
    const bool front = wa >= 0 && wb >= 0 && wc >= 0, back = wa <= 0 && wb <= 0 && wc <= 0;
    if (!front && !back) return missed_by([=] { return edge_against(wa, wb, wc); }, why);
    const Real det = wa + wb + wc;
    if (det == 0) return missed_by(Rejection::parallel, why);

    // t against its range before the division: the scaled t is t * |det|.
    const Real scaled = wa * (r.sz * a[r.kz]) + wb * (r.sz * b[r.kz]) + wc * (r.sz * c[r.kz]);
    const Real scaled_t = det < 0 ? -scaled : scaled, scale = std::abs(det);
    if (!(scaled_t >= r.ray.t_min * scale && scaled_t <= r.ray.t_max * scale)) return missed_by(Rejection::t, why);
    const Real inverse = 1 / det;
    return KernelHit<Real>{scaled * inverse, wb * inverse, wc * inverse};
  }

 private:
  template <class Wide>
  static Wide edge_function(Wide px, Wide py, Wide qx, Wide qy) {
    return px * qy - py * qx;
  }
};

}  // namespace plumbline::inline PLUMBLINE_KERNELS
