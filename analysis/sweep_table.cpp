#include "analysis/sweep_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "analysis/text_table.h"
#include "case/json_object.h"

namespace plumbline {
namespace {

struct Counter {
  std::string_view name;
  std::uint64_t (*of)(const Tally&);
};

// Those of the table and of JSON.
constexpr std::array<Counter, 9> counters = {{
    {"attempts", [](const Tally& t) { return t.attempts; }},
    {"successes", [](const Tally& t) { return t.successes; }},
    {"exact_successes", [](const Tally& t) { return t.exact_successes; }},
    {"harness_errors", [](const Tally& t) { return t.harness_errors(); }},
    {"false_misses", [](const Tally& t) { return t.false_misses; }},
    {"false_hits", [](const Tally& t) { return t.false_hits; }},
    {"lucky", [](const Tally& t) { return t.lucky(); }},
    {"unspecified", [](const Tally& t) { return t.unspecified; }},
    {"faults", [](const Tally& t) { return t.faults; }},
}};

// What takes successes and failures apart to the last ray; for the figures.
constexpr std::array<Counter, 3> fine_counters = {{
    {"lucky_misses", [](const Tally& t) { return t.lucky_misses; }},
    {"lucky_hits", [](const Tally& t) { return t.lucky_hits; }},
    {"unlucky_harness_errors", [](const Tally& t) { return t.unlucky_harness_errors; }},
}};

std::string percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "" : fmt::format("{:.2f}", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string target_text(const SweepRow& row) {
  switch (row.target) {
    case TargetKind::interior: return "interior";
    case TargetKind::vertex_edge: return "vertex/edge";
    case TargetKind::tolerance: break;
  }
  return fmt::format("tolerance {}", *row.tolerance);
}

std::string offset_text(const Vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

template <class Member>
bool varies(std::span<const SweepRow> rows, Member member) {
  return std::ranges::any_of(rows, [&](const SweepRow& row) { return row.*member != rows.front().*member; });
}

bool same_but_standoff(const SweepRow& p, const SweepRow& q) {
  return p.tracer == q.tracer && p.offset == q.offset && p.target == q.target && p.tolerance == q.tolerance;
}

// The least and the most that a counter comes to.
struct Range {
  const SweepRow *least, *most;
};

template <class Count>
Range range_of(const std::vector<const SweepRow*>& rows, Count count) {
  const auto less = [&](const SweepRow* p, const SweepRow* q) { return count(p->tally) < count(q->tally); };
  return {*std::ranges::min_element(rows, less), *std::ranges::max_element(rows, less)};
}

TextTable table_of_rows(std::span<const SweepRow> rows) {
  const bool with_offset = varies(rows, &SweepRow::offset), with_standoff = varies(rows, &SweepRow::standoff);
  TextTable table;
  table.columns = {{"tracer"}};
  if (with_offset) table.columns.push_back({"offset"});
  if (with_standoff) table.columns.push_back({"h", true});
  table.columns.push_back({"target"});
  for (const char* title :
       {"attempts", "successes", "%", "exact", "harness", "false miss", "false hit", "lucky", "unspecified", "fault"})
    table.columns.push_back({title, true});
  for (const SweepRow& row : rows) {
    std::vector<std::string> cells = {row.tracer->info().name};
    if (with_offset) cells.push_back(offset_text(row.offset));
    if (with_standoff) cells.push_back(fmt::format("{}", row.standoff));
    cells.push_back(target_text(row));
    for (const Counter& counter : counters) {
      cells.push_back(fmt::format("{}", counter.of(row.tally)));
      if (counter.name == "successes") cells.push_back(percent(row.tally.successes, row.tally.attempts));
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

TextTable table_over_standoffs(std::span<const SweepRow> rows) {
  TextTable table;
  table.columns = {
      {"tracer"},     {"offset"},     {"target"},  {"attempts", true}, {"least", true},       {"%", true},
      {"at h", true}, {"most", true}, {"%", true}, {"at h", true},     {"exact least", true}, {"exact most", true}};
  for (auto row = rows.begin(); row != rows.end(); ++row) {
    if (std::ranges::any_of(rows.begin(), row, [&](const SweepRow& r) { return same_but_standoff(r, *row); })) continue;
    std::vector<const SweepRow*> same;
    for (const SweepRow& r : rows)
      if (same_but_standoff(r, *row)) same.push_back(&r);
    const Range successes = range_of(same, [](const Tally& t) { return t.successes; });
    const Range exact = range_of(same, [](const Tally& t) { return t.exact_successes; });
    const auto text = [](auto value) { return fmt::format("{}", value); };
    std::vector<std::string> cells = {row->tracer->info().name, offset_text(row->offset), target_text(*row),
                                      text(row->tally.attempts)};
    for (const SweepRow* end : {successes.least, successes.most})
      cells.insert(cells.end(), {text(end->tally.successes), percent(end->tally.successes, end->tally.attempts),
                                 text(end->standoff)});
    cells.push_back(text(exact.least->tally.exact_successes));
    cells.push_back(text(exact.most->tally.exact_successes));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

bool has_several_standoffs(const SweepResult& result) { return varies(result.rows, &SweepRow::standoff); }

TextTable table_of(const SweepResult& result) {
  return has_several_standoffs(result) ? table_over_standoffs(result.rows) : table_of_rows(result.rows);
}

std::string caption(const SweepResult& result) {
  const auto [least, most] = std::ranges::minmax(result.rows, {}, &SweepRow::standoff);
  return fmt::format("{} triangles among the ordered triples [{}, {}); standoff h = {}\n\n", result.triangles,
                     result.done.first, result.done.end,
                     has_several_standoffs(result) ? fmt::format("{} to {}", least.standoff, most.standoff)
                                                   : fmt::format("{}", least.standoff));
}

constexpr std::string_view legend = R"(
successes: answer = wish. exact: truth = wish. harness: truth != wish. false miss, false hit: answer against truth.
lucky: answer = wish != truth. attempts - successes = harness + false miss + false hit - 2 lucky, but for rays of which
the contract leaves the answer open (unspecified) or the tracer gives none (fault). Truth is that of what a tracer is
asked: where its interface can't hold the ray, what that loses is harness too.
)";

}  // namespace

std::string to_terminal(const SweepResult& result) {
  return caption(result) + to_terminal(table_of(result)) + std::string(legend);
}

std::string to_markdown(const SweepResult& result) {
  return caption(result) + to_markdown(table_of(result)) + std::string(legend);
}

std::string to_csv(const SweepResult& result) {
  std::string text = "tracer,offset_x,offset_y,offset_z,standoff,target,tolerance";
  for (const Counter& counter : counters) text += fmt::format(",{}", counter.name);
  for (const Counter& counter : fine_counters) text += fmt::format(",{}", counter.name);
  text += '\n';
  for (const SweepRow& row : result.rows) {
    text += fmt::format("{},{},{},{},{},{},{}", row.tracer->info().name, row.offset.x, row.offset.y, row.offset.z,
                        row.standoff, name(row.target), row.tolerance ? fmt::format("{}", *row.tolerance) : "");
    for (const Counter& counter : counters) text += fmt::format(",{}", counter.of(row.tally));
    for (const Counter& counter : fine_counters) text += fmt::format(",{}", counter.of(row.tally));
    text += '\n';
  }
  return text;
}

std::string to_json_lines(const SweepResult& result) {
  std::string text;
  for (const SweepRow& row : result.rows) {
    JsonObject object(text);
    object.text("tracer", row.tracer->info().name);
    object.member("offset") += fmt::format("[{},{},{}]", row.offset.x, row.offset.y, row.offset.z);
    object.number("standoff", row.standoff);
    object.text("target", name(row.target));
    object.number("tolerance", row.tolerance);
    for (const Counter& counter : counters) object.member(counter.name) += fmt::format("{}", counter.of(row.tally));
    object.end_line();
  }
  return text;
}

}  // namespace plumbline
