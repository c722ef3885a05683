#include "analysis/reports/replay_junit.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/utf8.h"

namespace plumbline {
namespace {

// What XML 1.0 can't hold, most control characters, becomes U+FFFD. In an attribute, blanks would become spaces.
std::string xml(std::string_view text, bool in_attribute = true) {
  constexpr std::string_view replacement = "\xef\xbf\xbd", not_characters[] = {"\xef\xbf\xbe", "\xef\xbf\xbf"};
  const std::string utf8 = as_utf8(text);
  std::string out;
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    const char c = utf8[i];
    if (std::ranges::find(not_characters, std::string_view(utf8).substr(i, 3)) != std::end(not_characters)) {
      out += replacement;
      i += 2;
      continue;
    }
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\r': out += "&#13;"; break;
      case '\n': out += in_attribute ? "&#10;" : "\n"; break;
      case '\t': out += in_attribute ? "&#9;" : "\t"; break;
      default: static_cast<unsigned char>(c) < 0x20 ? out += replacement : out += c;
    }
  }
  return out;
}

void append_testcase(std::string& out, const ReplaySummary& summary, const ReplayResult& result) {
  const ReplayedCase& at = summary.cases[result.which];
  out += fmt::format(R"(    <testcase classname="{0}" name="{1}" file="{0}" line="{2}")", xml(at.path), xml(at.id),
                     at.line);
  if (!result.rule) {
    out += "/>\n";
  } else if (!disagrees(result)) {
    out += fmt::format(">\n      <skipped message=\"{}\"/>\n    </testcase>\n", xml(result.message));
  } else {
    out += fmt::format(">\n      <failure type=\"{}\" message=\"{}\">{}</failure>\n    </testcase>\n",
                       name(*result.rule), xml(result.message), xml(result.message + "\n" + result.why, false));
  }
}

// Of those results that are `of` this tracer, or of none.
void append_testsuite(std::string& out, const ReplaySummary& summary, std::optional<std::size_t> of) {
  std::size_t tests = 0, failures = 0, skipped = 0;
  std::string testcases;
  for (const ReplayResult& result : summary.results) {
    if (result.tracer != of) continue;
    ++tests;
    if (disagrees(result)) ++failures;
    if (result.rule && !disagrees(result)) ++skipped;
    append_testcase(testcases, summary, result);
  }
  if (tests == 0) return;
  out += fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\">\n{}  </testsuite>\n",
      of ? xml(summary.tracers[*of]) : "what the files expect", tests, failures, skipped, testcases);
}

}  // namespace

std::string to_junit(const ReplaySummary& summary) {
  std::string suites;
  append_testsuite(suites, summary, std::nullopt);
  for (std::size_t i = 0; i < summary.tracers.size(); ++i) append_testsuite(suites, summary, i);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites name=\"plumbline replay\" tests=\"{}\" failures=\"{}\" errors=\"0\">\n{}</testsuites>\n",
      summary.results.size(), summary.disagreements(), suites);
}

}  // namespace plumbline
