// What BRL-CAD's tracers, the real one and its rules, answer of the pieces of a ray inside the object.
#pragma once
#include <span>

#include "case/answer.h"

namespace plumbline::brlcad {

/// In and out of the first piece; of none a miss. Where `thin`, in is the hit itself.
inline Answer answer_of(std::span<const Passage> passages, bool thin) {
  if (passages.empty()) return {};
  const Passage& first = passages.front();
  Answer answer{.outcome = Outcome::hit,
                .has_t = thin,
                .has_segment = true,
                .triangle = first.triangle_in,
                .in = first.in,
                .out = first.out};
  if (thin) answer.t = first.in;
  return answer;
}

}  // namespace plumbline::brlcad
