// Correct rounding of an exact quotient, or of its square root, to binary32 or binary64: to nearest, ties to even, once,
// straight from the exact value. (mpq_get_d truncates, and binary32 by way of binary64 rounds twice.)
// Integer arithmetic only: no Ziv loop is needed, since the remainder of an integer division and of an integer square
// root tell on which side of a tie the exact value lies. Subnormals are rounded as subnormals; what is beyond the
// format's range becomes an infinity, as IEEE 754 section 4.3.1 says.
#pragma once
#include "oracle/dyadic.h"

namespace plumbline::exact {

template <class Real>
Real rounded(const Quotient& x);

/// Of the square root; x >= 0.
template <class Real>
Real rounded_sqrt(const Quotient& x);

}  // namespace plumbline::exact
