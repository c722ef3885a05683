// Whether points have a place: no NaN, no infinity among their coordinates. By their bits, as float_bits.h.
#pragma once
#include "case/float_bits.h"
#include "case/geometry.h"

namespace plumbline {

inline bool is_finite(const Vec3& v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }
inline bool is_finite(const Triangle& t) { return is_finite(t.a) && is_finite(t.b) && is_finite(t.c); }

}  // namespace plumbline
