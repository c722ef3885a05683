#include "analysis/reports/replay_github.h"

#include <fmt/format.h>

#include "case/utf8.h"

namespace plumbline {
namespace {

// As the runner undoes it: these characters in the message, `in_property` two more in front of it.
std::string escaped(std::string_view text, bool in_property) {
  std::string out;
  for (const char c : as_utf8(text)) {
    if (c == '%' || c == '\r' || c == '\n' || (in_property && (c == ':' || c == ','))) {
      out += fmt::format("%{:02X}", c);
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

std::string to_github(const ReplaySummary& summary) {
  std::string out;
  for (const ReplayResult& result : summary.results) {
    if (!result.rule) continue;
    const ReplayedCase& at = summary.cases[result.which];
    const std::string whose = result.tracer ? summary.tracers[*result.tracer] + ": " : "";
    out +=
        fmt::format("::{} file={},line={},title={}::{}\n", disagrees(result) ? "error" : "warning",
                    escaped(at.path, true), at.line, escaped(fmt::format("plumbline {}", name(*result.rule)), true),
                    escaped(fmt::format("{}: {}{}\n{}", at.id, whose, result.message, result.why), false));
  }
  return out;
}

}  // namespace plumbline
