// The nearest hit of a bag, for libraries that are asked one triangle at a time.
#pragma once
#include <cstddef>
#include <cstdint>

#include "case/answer.h"

namespace plumbline {

/// `shoot(triangle)` answers for one of them. Of hits equally far, the first.
template <class Triangles, class Shoot>
Answer nearest(Triangles& triangles, const Shoot& shoot) {
  Answer best;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Answer answer = shoot(triangles[i]);
    if (answer.outcome != Outcome::hit || (best.outcome == Outcome::hit && !(answer.t < best.t))) continue;
    answer.triangle = static_cast<std::uint32_t>(i);
    best = answer;
  }
  return best;
}

}  // namespace plumbline
