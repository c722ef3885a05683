// What the filter computes of a case, in the floating-point environment of the caller: its determinants, and the bounds
// of their errors as oracle/batch_kernel.h derives them (128 u, 256 u for w_bc; u = 2^-53).
#pragma once
#include "case/hard_families.h"

namespace plumbline {

struct FilterValues {
  double det, T, w_ab, w_bc, w_ca, V;  ///< V at t_min
  double det_bound, T_bound, w_bound, w_bc_bound, V_bound;
};
FilterValues filter_values(const Shot& shot);

}  // namespace plumbline
