#include "analysis/reports/replay_json.h"

#include "case/json_object.h"

namespace plumbline {
namespace {

template <class Enum>
std::optional<std::string_view> name_of(std::optional<Enum> value) {
  return value ? std::optional(name(*value)) : std::nullopt;
}

std::optional<std::string_view> unless_empty(std::string_view text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

}  // namespace

std::string to_json_lines(const ReplaySummary& summary) {
  std::string out;
  for (const ReplayResult& result : summary.results) {
    const ReplayedCase& at = summary.cases[result.which];
    const auto& severity = result.severity;
    JsonObject object(out);
    object.text("file", at.path);
    object.number("line", static_cast<double>(at.line));
    object.text("id", at.id);
    object.text("tracer",
                result.tracer ? std::optional<std::string_view>(summary.tracers[*result.tracer]) : std::nullopt);
    object.text("verdict", name_of(result.verdict));
    object.text("known", name_of(result.known));
    object.number("severity", severity ? std::optional(severity->length) : std::nullopt);
    object.number("severity_ulps", severity ? std::optional(severity->ulps) : std::nullopt);
    object.text("signature", unless_empty(result.signature));
    object.boolean("as_stated", !disagrees(result));
    object.text("rule", name_of(result.rule));
    object.text("message", unless_empty(result.message));
    object.end_line();
  }
  return out;
}

}  // namespace plumbline
