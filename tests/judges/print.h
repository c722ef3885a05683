// How GoogleTest prints what judges disagree on.
#pragma once
#include <ostream>

#include "case/hard_families.h"
#include "oracle/truth.h"

namespace plumbline {

inline void PrintTo(Family family, std::ostream* out) { *out << name(family); }

inline void PrintTo(const Truth& t, std::ostream* out) {
  *out << name(t.hit_class) << ' ' << name(t.feature) << " det " << int{t.det_sign} << " t_min " << int{t.versus_t_min}
       << " t_max " << int{t.versus_t_max} << " invalid " << static_cast<int>(t.invalid);
}

}  // namespace plumbline
