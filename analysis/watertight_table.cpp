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
constexpr std::array<Counter, 7> counters = {{{"leaks", &LeakScore::leaks},
                                              {"doubles", &LeakScore::doubles},
                                              {"displaced", &LeakScore::displaced},
                                              {"parity", &LeakScore::parity},
                                              {"bag_leaks", &LeakScore::bag_leaks},
                                              {"nearest", &LeakScore::nearest},
                                              {"false_hits", &LeakScore::false_hits}}};

using Part = std::uint64_t LeakCount::*;

std::string number(std::uint64_t n) { return n == 0 ? "." : std::to_string(n); }
std::string ulps(double worst) { return worst == 0 ? "" : fmt::format("{:.3g}", worst); }

// A table's tests are those of one precision: of spheres, or of all else.
std::vector<std::size_t> tests_of(Precision precision, bool spheres) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < leak_tests().size(); ++i)
    if (leak_tests()[i].precision == precision && (leak_tests()[i].family == BagFamily::sphere) == spheres)
      list.push_back(i);
  return list;
}

std::vector<std::string> small_cells(const LeakScore& s, Part part) {
  const auto leaks = s.leaks.*part, doubles = s.doubles.*part;
  return {leaks + doubles == 0 ? "." : fmt::format("{}/{}", leaks, doubles)};
}

std::string with_culled(std::initializer_list<std::uint64_t> counts, std::uint64_t culled) {
  if (std::ranges::all_of(counts, [](std::uint64_t n) { return n == 0; })) return ".";
  return fmt::format("{}/{}", fmt::join(counts, "/"), culled);
}

std::vector<std::string> sphere_cells(const LeakScore& s, Part part) {
  return {with_culled({s.leaks.*part, s.bag_leaks.*part}, s.culled_leaks),
          with_culled({s.nearest.*part}, s.culled_nearest), number(s.parity.*part)};
}

TextTable table_of(const LeakResult& result, Precision precision, bool spheres) {
  const auto tests = tests_of(precision, spheres);
  TextTable table{.columns = {{"tracer"}}, .rows = {}};
  for (const std::size_t test : tests) {
    const std::string name(leak_tests()[test].name);
    if (!spheres) table.columns.push_back({name, true});
    if (!spheres) continue;
    const std::string aimed_at = name.substr(name.find(' ') + 1);
    for (const char* title : {": leaks", ": nearest", ": parity"}) table.columns.push_back({aimed_at + title, true});
  }
  for (const char* title :
       {"worst leak, ulps", spheres ? "worst nearest, ulps" : "worst double, ulps", "apart", "faults"})
    table.columns.push_back({title, true});
  const auto cells = spheres ? sphere_cells : small_cells;
  for (std::size_t i = 0; i < result.scores.size(); ++i) {
    std::vector<std::string> all = {result.plan.tracers[i]->info().name}, broken = {"  by its contract"};
    LeakScore sum;
    for (const std::size_t test : tests) {
      const LeakScore& score = result.scores[i][test];
      sum += score;
      std::ranges::copy(cells(score, &LeakCount::all), std::back_inserter(all));
      std::ranges::copy(cells(score, &LeakCount::broken), std::back_inserter(broken));
    }
    if (sum.rays == 0) continue;
    const bool differs = !std::equal(all.begin() + 1, all.end(), broken.begin() + 1);
    all.insert(all.end(), {ulps(std::max(sum.leaks.worst, sum.bag_leaks.worst)),
                           ulps(spheres ? sum.nearest.worst : sum.doubles.worst),
                           sum.apart == 0 ? "" : number(sum.apart), sum.faults == 0 ? "" : number(sum.faults)});
    broken.resize(all.size());
    table.rows.push_back(all);
    if (differs) table.rows.push_back(broken);
  }
  return table;
}

constexpr std::string_view small_legend =
    "Triangles asked one by one, leaks/double hits: something is crossed and nothing is hit, or too much.\n"
    "ulp: by up to an ulp in each component beside an edge or vertex; exact: through it.\n";
constexpr std::string_view sphere_legend =
    "Closed spheres, by up to an ulp beside vertices and points of edges: from inside each, and both from outside,\n"
    "into the sphere and out of it. leaks: triangles asked one by one/the bag as a whole/of these, lost in boxes "
    "and\n"
    "traversal, for the triangle alone is hit. nearest: the bag's answer is another triangle/of these, lost "
    "likewise.\n"
    "parity: triangles one by one, an even number of hits for an odd one, or the other way round.\n";

std::string text_of(const LeakResult& result, std::string (*render)(const TextTable&), std::string_view heading) {
  std::string text;
  for (const Precision precision : {Precision::binary32, Precision::binary64})
    for (const bool spheres : {false, true}) {
      const TextTable table = table_of(result, precision, spheres);
      if (table.rows.empty()) continue;
      text += fmt::format("{}{}{} inputs, {}: {} rays a column\n\n", text.empty() ? "" : "\n", heading,
                          name(precision), spheres ? "closed spheres" : "pairs, fans, strips", result.plan.rays);
      text += fmt::format("{}\n{}", spheres ? sphere_legend : small_legend, render(table));
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
