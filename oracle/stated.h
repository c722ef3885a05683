// What a .case file states, against what is: its line `expect` and its lines `known`. The rules by which a replay is
// right or wrong, whoever asks the tracer.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "case/case.h"
#include "case/verdict.h"
#include "oracle/severity.h"

namespace plumbline {

/// What there may be to tell of a case. The words stay as they are: people's filters go by them.
enum class ReplayRule : unsigned char {
  false_miss,
  false_hit,
  fault,
  known_now_passes,
  expectation_differs,
  leak,
  wrong_nearest,
};
inline constexpr std::array<std::string_view, 7> replay_rule_names = {
    "false-miss", "false-hit", "fault", "known-now-passes", "expectation-differs", "leak", "wrong-nearest"};
constexpr std::string_view name(ReplayRule r) { return replay_rule_names[static_cast<unsigned>(r)]; }

/// What the truth has otherwise than the case expects, in one line; empty if nothing. The bag holds one triangle.
std::string expectation_differences(const Case& asked);

/// As what the case lists this tracer; none: it doesn't.
std::optional<VerdictKind> known_as(const Case& asked, std::string_view tracer);

/// What there is to tell of a verdict; none: it is as listed, or right and not listed.
std::optional<ReplayRule> rule_of(VerdictKind verdict, std::optional<VerdictKind> known);

/// A fault that isn't listed is told, and is no disagreement: the tracer didn't claim anything.
constexpr bool disagrees(std::optional<ReplayRule> rule, std::optional<VerdictKind> known) {
  return rule && (*rule != ReplayRule::fault || known);
}

/// The rule in one line: "new false-hit, severity 1.1e-16 (0.5 ulps)". The severity is that of a wrong answer.
std::string rule_message(VerdictKind verdict, std::optional<VerdictKind> known,
                         const std::optional<Severity>& severity);

}  // namespace plumbline
