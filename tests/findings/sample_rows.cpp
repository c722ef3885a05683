#include "tests/findings/sample_rows.h"

#include <fmt/format.h>

#include <cmath>

#include "case/random.h"

namespace plumbline {

std::vector<std::string> hostile_names() {
  return {"<script>alert(1)</script>",
          "</script><script>alert(2)</script>",
          "'; DROP TABLE findings; --",
          "\"quotes\" & 'more' <b>",
          "two\nlines",
          "{{data}}",
          "a#b?c=d&tracer=e%20f",
          "\x01\x02"
          "control",
          "<!--<script>"};
}

Case case_at(std::string id, double x, double y) {
  Case made;
  made.id = std::move(id);
  made.bag.triangles = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  made.ray = {{x, y, 1}, {0, 0, -1}};
  return made;
}

FindingRow sample_row(std::int64_t id, std::string tracer) {
  FindingRow row;
  row.id = id;
  row.tracer = std::move(tracer);
  row.signature = "false-hit-ab-nominal-c0";
  row.kind = FindingKind::false_hit;
  row.element = Element::ab;
  row.count = 7;
  row.worst = {.ulps = 4, .bits = 6, .what = case_at("worst", 0.375, -0x1p-50)};
  row.simplest = {.ulps = 2, .bits = 5, .what = case_at("simplest", 0.5, -0x1p-51)};
  row.builds = {"clang 19.1.7, -O2"};
  row.first_seen = "2026-01-02T03:04:05Z";
  row.last_seen = "2026-02-03T04:05:06Z";
  return row;
}

std::vector<FindingRow> many_rows(std::size_t count) {
  Random random(1, 0);
  const auto below = [&random](std::uint64_t n) { return random.below(n); };
  std::vector<FindingRow> rows;
  rows.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    FindingRow row = sample_row(static_cast<std::int64_t>(k) + 1, fmt::format("tracer_{}", below(40)));
    row.kind = static_cast<FindingKind>(below(finding_kind_names.size()));
    row.element = static_cast<Element>(below(element_names.size()));
    row.conditioning = static_cast<Conditioning>(below(conditioning_names.size()));
    row.signature = fmt::format("{}-{}-{}-c{}{}", name(row.kind), name(row.element), name(row.conditioning), below(5),
                                below(9) == 0 ? "-lucky" : "");
    row.worst.ulps = std::ldexp(1.0 + static_cast<double>(below(1000)) / 1000, static_cast<int>(below(60)) - 5);
    row.simplest.bits = static_cast<unsigned>(below(900));
    row.count = 1 + below(1000000);
    row.status = static_cast<FindingStatus>(below(finding_status_names.size()));
    row.first_seen = fmt::format("202{}-{:02}-{:02}T01:30:00Z", below(7), 1 + below(12), 1 + below(28));
    row.last_seen = fmt::format("202{}-{:02}-{:02}T01:30:00Z", 7 + below(3), 1 + below(12), 1 + below(28));
    row.is_new = below(20) == 0;
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace plumbline
