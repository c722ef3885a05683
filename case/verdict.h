// What the comparison of an answer with the truth comes to.
#pragma once
#include <array>
#include <string_view>

namespace plumbline {

/// false_miss, false_hit: the answer contradicts the truth where the tracer's contract speaks.
/// unspecified: the contract leaves this case open, so no answer is wrong. fault: the tracer gave no answer at all.
/// Of several triangles there is no false miss: leak: nothing is hit where something has to be; wrong_nearest:
/// something else is hit than has to be first.
enum class VerdictKind : unsigned char { correct, false_miss, false_hit, unspecified, fault, leak, wrong_nearest };

inline constexpr std::array<std::string_view, 7> verdict_kind_names = {
    "correct", "false-miss", "false-hit", "unspecified", "fault", "leak", "wrong-nearest"};

constexpr std::string_view name(VerdictKind k) { return verdict_kind_names[static_cast<unsigned>(k)]; }

}  // namespace plumbline
