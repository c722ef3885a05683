// How much of the truth a method tells, and whether what it tells is so. What a method does not tell is not held
// against it; every answer is written as a Truth.
#pragma once
#include <array>
#include <string_view>

#include "oracle/truth.h"

namespace plumbline {

enum class Answers : unsigned char {
  hit,      ///< whether the line crosses the closed triangle in the range; open where it is coplanar or degenerate
  feature,  ///< whether the line crosses the closed triangle, at any t, and in the interior or at which edge or vertex
  truth,    ///< all of a Truth
};
inline constexpr std::array<std::string_view, 3> answers_names = {"hit", "feature", "truth"};
constexpr std::string_view name(Answers a) { return answers_names[static_cast<unsigned>(a)]; }

/// The Truth for an answer of Answers::hit.
constexpr Truth hit_or_miss(bool hit) { return {.hit_class = hit ? HitClass::interior : HitClass::exterior}; }

constexpr bool is_wrong(Answers answers, const Truth& answer, const Truth& truth) {
  const auto meets = [](const Truth& t) { return t.hit_class <= HitClass::vertex; };
  switch (answers) {
    case Answers::hit:
      if (truth.hit_class == HitClass::coplanar || truth.hit_class == HitClass::degenerate) return false;
      return crosses(answer) != crosses(truth);
    case Answers::feature:
      if (!meets(answer) || !meets(truth)) return meets(answer) != meets(truth);
      return answer.hit_class != truth.hit_class || answer.feature != truth.feature;
    case Answers::truth: break;
  }
  return answer != truth;
}

}  // namespace plumbline
