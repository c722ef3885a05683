// An independent judge: the direct formula of the contract in GMP's mpq_class, nothing factored out, nothing scaled.
// About 10 us a case, so that tens of millions can be asked. Call it in the default floating-point environment.
#pragma once
#include <gmpxx.h>

#include "case/query.h"
#include "oracle/truth.h"

namespace plumbline::judges {

/// As oracle/README.md writes them. All coordinates are finite.
struct Determinants {
  mpq_class det, T, w_ab, w_bc, w_ca;
  bool flat = false;  ///< (b-a) x (c-a) = 0
};
Determinants mpq_determinants(const Triangle& triangle, const Query& query);

/// The case is not invalid.
Truth mpq_truth(const Triangle& triangle, const Query& query);

}  // namespace plumbline::judges
