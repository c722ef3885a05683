#include "analysis/watertight_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "analysis/csv.h"
#include "analysis/text_table.h"

namespace plumbline {
namespace {

struct Counter {
  std::string_view name;
  LeakCount LeakScore::*count;
};
constexpr std::array<Counter, 8> counters = {{{"leaks", &LeakScore::leaks},
                                              {"doubles", &LeakScore::doubles},
                                              {"displaced", &LeakScore::displaced},
                                              {"order", &LeakScore::order},
                                              {"parity", &LeakScore::parity},
                                              {"bag_leaks", &LeakScore::bag_leaks},
                                              {"nearest", &LeakScore::nearest},
                                              {"false_hits", &LeakScore::false_hits}}};

using Part = std::uint64_t LeakCount::*;

std::string number(std::uint64_t n) { return n == 0 ? "." : std::to_string(n); }
std::string ulps(double worst) { return worst == 0 ? "" : fmt::format("{:.3g}", worst); }

std::vector<std::size_t> tests_of(Precision precision, LeakTable table) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < leak_tests().size(); ++i)
    if (leak_tests()[i].precision == precision && leak_tests()[i].table == table) list.push_back(i);
  return list;
}

std::string counts(std::initializer_list<std::uint64_t> list) {
  if (std::ranges::all_of(list, [](std::uint64_t n) { return n == 0; })) return ".";
  return fmt::format("{}", fmt::join(list, "/"));
}

std::vector<std::string> shared_cells(const LeakScore& s, Part part) {
  return {counts({s.leaks.*part, s.doubles.*part})};
}

std::vector<std::string> sphere_cells(const LeakScore& s, Part part) {
  const bool leaks = s.leaks.*part + s.bag_leaks.*part > 0, nearest = s.nearest.*part > 0;
  return {leaks ? counts({s.leaks.*part, s.bag_leaks.*part, s.culled_leaks}) : ".",
          nearest ? counts({s.nearest.*part, s.culled_nearest}) : ".", number(s.parity.*part)};
}

std::vector<std::string> layered_cells(const LeakScore& s, Part part) {
  const bool lost = s.bag_leaks.*part + s.nearest.*part > 0;
  return {
      counts({s.leaks.*part, s.doubles.*part, s.order.*part}),
      counts({s.bag_leaks.*part, s.nearest.*part, s.false_hits.*part, lost ? s.culled_leaks + s.culled_nearest : 0})};
}

// What is told of the tests of a table.
struct Layout {
  LeakTable table;
  std::string_view title, legend;
  std::vector<std::string> (*cells)(const LeakScore&, Part);
  std::vector<std::string_view> columns;  // of a test, behind its name; one that is empty has the name alone
  std::string_view second;                // beside leaks, whose worst is told
  LeakCount LeakScore::*second_count;
};

const std::array<Layout, 3> layouts = {
    {{LeakTable::shared,
      "pairs, fans, strips",
      "Triangles asked one by one, leaks/double hits: something is crossed and nothing is hit, or too much.\n"
      "ulp: by up to an ulp in each component beside an edge or vertex; exact: through it.\n",
      shared_cells,
      {""},
      "double",
      &LeakScore::doubles},
     {LeakTable::spheres,
      "closed spheres",
      "By up to an ulp beside vertices and points of edges: from inside each, and both from outside, into the sphere\n"
      "and out of it. leaks: triangles asked one by one/the bag as a whole/of these, lost in boxes and traversal, for\n"
      "the triangle alone is hit. nearest: the bag's answer is another triangle/of these, lost likewise. parity:\n"
      "triangles one by one, an even number of hits for an odd one, or the other way round.\n",
      sphere_cells,
      {": leaks", ": nearest", ": parity"},
      "nearest",
      &LeakScore::nearest},
     {LeakTable::layered,
      "sheets, overlaps, a lattice, grazing rays",
      "Parallel sheets, some an ulp or two apart; triangles that overlap in one plane; pairs with vertices from\n"
      "{-1, 0, 1}^3, some without area; rays all but in the plane of a triangle. alone: triangles one by one,\n"
      "leaks/double hits/a farther one hit at a smaller t. bag: as a whole, leaks/another triangle than the\n"
      "nearest/false hits/of the former two, lost in boxes and traversal.\n",
      layered_cells,
      {": alone", ": bag"},
      "nearest",
      &LeakScore::nearest}}};

TextTable table_of(const LeakResult& result, Precision precision, const Layout& layout) {
  const auto tests = tests_of(precision, layout.table);
  TextTable table{.columns = {{"tracer"}}, .rows = {}};
  for (const std::size_t test : tests) {
    std::string_view name = leak_tests()[test].name;
    if (layout.table == LeakTable::spheres) name.remove_prefix(name.find(' ') + 1);
    for (const std::string_view column : layout.columns)
      table.columns.push_back({fmt::format("{}{}", name, column), true});
  }
  for (const auto& title : {std::string("worst leak, ulps"), fmt::format("worst {}, ulps", layout.second),
                            std::string("apart"), std::string("faults")})
    table.columns.push_back({title, true});
  for (std::size_t i = 0; i < result.scores.size(); ++i) {
    std::vector<std::string> all = {result.plan.tracers[i]->info().name}, broken = {"  by its contract"};
    LeakScore sum;
    for (const std::size_t test : tests) {
      const LeakScore& score = result.scores[i][test];
      sum += score;
      std::ranges::copy(layout.cells(score, &LeakCount::all), std::back_inserter(all));
      std::ranges::copy(layout.cells(score, &LeakCount::broken), std::back_inserter(broken));
    }
    if (sum.rays == 0) continue;
    const bool differs = !std::equal(all.begin() + 1, all.end(), broken.begin() + 1);
    all.insert(all.end(), {ulps(std::max(sum.leaks.worst, sum.bag_leaks.worst)), ulps((sum.*layout.second_count).worst),
                           sum.apart == 0 ? "" : number(sum.apart), sum.faults == 0 ? "" : number(sum.faults)});
    broken.resize(all.size());
    table.rows.push_back(all);
    if (differs) table.rows.push_back(broken);
  }
  return table;
}

std::string text_of(const LeakResult& result, std::string (*render)(const TextTable&), std::string_view heading) {
  std::string text;
  for (const Precision precision : {Precision::binary32, Precision::binary64})
    for (const Layout& layout : layouts) {
      const TextTable table = table_of(result, precision, layout);
      if (table.rows.empty()) continue;
      text += fmt::format("{}{}{} inputs, {}: {} rays a column\n\n{}\n{}", text.empty() ? "" : "\n", heading,
                          name(precision), layout.title, result.plan.rays, layout.legend, render(table));
    }
  return text;
}

}  // namespace

std::string to_terminal(const LeakResult& result) { return text_of(result, to_terminal, ""); }
std::string to_markdown(const LeakResult& result) { return text_of(result, to_markdown, "## "); }

std::string to_csv(const LeakResult& result) {
  std::string text = "tracer,precision,test,rays";
  for (const Counter& c : counters) text += fmt::format(",{0},{0}_broken,{0}_worst_ulps", c.name);
  text += ",culled_leaks,culled_nearest,apart,faults\n";
  for (std::size_t i = 0; i < result.scores.size(); ++i)
    for (std::size_t k = 0; k < leak_tests().size(); ++k) {
      const LeakScore& score = result.scores[i][k];
      if (score.rays == 0) continue;
      const LeakTest& test = leak_tests()[k];
      text += fmt::format("{},{},{},{}", csv_field(result.plan.tracers[i]->info().name), name(test.precision),
                          csv_field(test.name), score.rays);
      for (const Counter& c : counters) {
        const LeakCount& count = score.*c.count;
        text += fmt::format(",{},{},{}", count.all, count.broken, count.worst);
      }
      text += fmt::format(",{},{},{},{}\n", score.culled_leaks, score.culled_nearest, score.apart, score.faults);
    }
  return text;
}

}  // namespace plumbline
