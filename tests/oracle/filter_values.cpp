#include "tests/oracle/filter_values.h"

#include <algorithm>
#include <cmath>

#include "oracle/batch_kernel.h"

namespace plumbline {

FilterValues filter_values(const Shot& shot) {
  using Kernel = BatchKernel<1>;
  const auto vec = [](const Vec3& v) { return Kernel::RealVec{v.x, v.y, v.z}; };
  const auto& [t, r] = shot;
  const Kernel::Determinants<Kernel::RealVec> x(vec(r.origin), vec(r.direction), vec(t.a), vec(t.b), vec(t.c));
  const double d = Kernel::max_norm(vec(r.direction)), a = Kernel::max_norm(x.a),
               e = std::max(Kernel::max_norm(x.e1), Kernel::max_norm(x.e2));
  constexpr double u = 0x1p-53;
  const double det_bound = 128 * u * d * e * e, T_bound = 128 * u * a * e * e, w_bound = 128 * u * d * a * e;
  return {.det = x.det,
          .T = x.T,
          .w_ab = x.w_ab,
          .w_bc = x.w_bc,
          .w_ca = x.w_ca,
          .V = x.T - r.t_min * x.det,
          .det_bound = det_bound,
          .T_bound = T_bound,
          .w_bound = w_bound,
          .w_bc_bound = 256 * u * d * e * (a + e),
          .V_bound = T_bound + std::fabs(r.t_min) * det_bound};
}

}  // namespace plumbline
