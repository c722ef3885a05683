// Signs of the determinants: what one stage knows of them for the next, and the class they make. Private to the oracle.
#pragma once
#include "oracle/truth.h"

namespace plumbline {

/// What is proved of a case that is not decided: -1, 0, 1 or unknown. Where det is unknown, so is the rest.
struct KnownSigns {
  static constexpr signed char unknown = 2;
  signed char det = unknown;
  signed char ab = unknown, bc = unknown, ca = unknown;  ///< of w times the sign of det
  signed char past_min = unknown, past_max = unknown;    ///< of t - t_min, t - t_max
  signed char unused[2] = {};
};

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
