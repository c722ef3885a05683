// From the signs of the determinants to the class. Shared by the scalar stages; private to the oracle.
#pragma once
#include "oracle/truth.h"

namespace plumbline {

/// det != 0: class and feature from the signs of the w, each multiplied by the sign of det.
inline void place(Truth& truth, int ab, int bc, int ca) {
  if ((ab | bc | ca) < 0) {
    truth.hit_class = HitClass::exterior;
    return;
  }
  // A zero w puts the line on that edge; two, on the vertex between. Three would make det zero.
  constexpr Feature features[8] = {Feature::none, Feature::ab, Feature::bc, Feature::b,
                                   Feature::ca,   Feature::a,  Feature::c,  Feature::none};
  truth.feature = features[(ab == 0 ? 1 : 0) | (bc == 0 ? 2 : 0) | (ca == 0 ? 4 : 0)];
  truth.hit_class = truth.feature == Feature::none ? HitClass::interior
                    : truth.feature < Feature::a   ? HitClass::edge
                                                   : HitClass::vertex;
}

}  // namespace plumbline
