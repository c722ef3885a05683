#include "analysis/compare_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/text_table.h"
#include "case/case_text.h"
#include "case/json_object.h"

namespace plumbline {
namespace {

constexpr std::size_t most_in_duels = 4;

std::string wrong_of(std::uint64_t misses, std::uint64_t hits) {
  return misses + hits == 0 ? "." : fmt::format("{}/{}", misses, hits);
}

// Only families of which at least one tracer was asked.
TextTable score_table(const CompareResult& result) {
  const auto& families = result.plan.families;
  TextTable table{.columns = {{"tracer"}}, .rows = {}};
  for (const Family family : families) table.columns.push_back({std::string(name(family)), true});
  for (const char* title : {"boundary hit %", "worst S_N, ulps", "open", "faults"}) table.columns.push_back({title, true});
  for (std::size_t i = 0; i < result.scores.size(); ++i) {
    const auto& scores = result.scores[i];
    const std::string& tracer = result.plan.tracers[i]->info().name;
    std::vector<std::string> row = {tracer}, as_ray = {"  asked the ray"};
    Score sum;
    for (const Score& s : scores) {
      row.push_back(wrong_of(s.false_misses, s.false_hits));
      as_ray.push_back(wrong_of(s.ray_false_misses, s.ray_false_hits));
      sum.boundary += s.boundary;
      sum.boundary_hits += s.boundary_hits;
      sum.unspecified += s.unspecified;
      sum.faults += s.faults;
      sum.worst_nominal_ulps = std::max(sum.worst_nominal_ulps, s.worst_nominal_ulps);
    }
    const bool differs = !std::equal(row.begin() + 1, row.end(), as_ray.begin() + 1);
    row.push_back(sum.boundary == 0 ? "" : fmt::format("{:.1f}", 100.0 * static_cast<double>(sum.boundary_hits) /
                                                                      static_cast<double>(sum.boundary)));
    row.push_back(sum.worst_nominal_ulps == 0 ? "" : fmt::format("{:.3g}", sum.worst_nominal_ulps));
    row.push_back(sum.unspecified == 0 ? "" : std::to_string(sum.unspecified));
    row.push_back(sum.faults == 0 ? "" : std::to_string(sum.faults));
    table.rows.push_back(row);
    if (!differs) continue;
    as_ray.resize(row.size());
    table.rows.push_back(as_ray);
  }
  return table;
}

template <class Visit>
void for_each_duel(const CompareResult& result, Visit visit) {
  const std::size_t tracers = result.plan.tracers.size();
  for (std::size_t i = 0; i < tracers; ++i)
    for (std::size_t j = i + 1; j < tracers; ++j)
      for (std::size_t family = 0; family < result.plan.families.size(); ++family)
        for (std::size_t k = 0; k < hit_class_names.size(); ++k) {
          const Duel& duel = result.duels[pair_index(i, j, tracers)][family][k];
          if (duel.differ > 0)
            visit(result.plan.tracers[i]->info().name, result.plan.tracers[j]->info().name,
                  name(result.plan.families[family]), hit_class_names[k], duel);
        }
}

TextTable duel_table(const CompareResult& result) {
  TextTable table{.columns = {{"first"}, {"second"}, {"family"}, {"class"}, {"differ", true}, {"first right", true},
                              {"second right", true}, {"open", true}},
                  .rows = {}};
  for_each_duel(result, [&](const std::string& first, const std::string& second, std::string_view family,
                            std::string_view hit_class, const Duel& duel) {
    table.rows.push_back({first, second, std::string(family), std::string(hit_class), std::to_string(duel.differ),
                          std::to_string(duel.first_right), std::to_string(duel.second_right),
                          std::to_string(duel.differ - duel.first_right - duel.second_right)});
  });
  return table;
}

TextTable worst_table(const CompareResult& result) {
  TextTable table{.columns = {{"case"}, {"what"}}, .rows = {}};
  for (const auto& families : result.worst) {
    const WrongCase* worst = nullptr;
    for (const auto& list : families)
      for (const WrongCase& c : list)
        if (!worst || (c.nominal != worst->nominal ? c.nominal : c.ulps > worst->ulps)) worst = &c;
    if (worst) table.rows.push_back({worst->asked.id, worst->asked.provenance.front()});
  }
  return table;
}

template <class Render>
std::string text(const CompareResult& result, Render render) {
  const ComparePlan& plan = result.plan;
  std::string out = fmt::format("{} cases of each family, {} inputs, seed {}. Cells: false misses/false hits.\n\n", plan.count,
                                name(plan.inputs), plan.seed);
  out += render(score_table(result));
  if (const TextTable worst = worst_table(result); !worst.rows.empty())
    out += "\nThe worst case of each:\n\n" + render(worst);
  if (plan.tracers.size() < 2 || plan.tracers.size() > most_in_duels) return out;
  const TextTable duels = duel_table(result);
  return out + (duels.rows.empty() ? std::string("\nNo two of them disagree.\n")
                                   : "\nWhere two of them disagree, and who is right:\n\n" + render(duels));
}

}  // namespace

std::string to_terminal(const CompareResult& result) {
  return text(result, [](const TextTable& table) { return to_terminal(table); });
}

std::string to_markdown(const CompareResult& result) {
  return text(result, [](const TextTable& table) { return to_markdown(table); });
}

std::string to_json_lines(const CompareResult& result) {
  std::string out;
  for (std::size_t i = 0; i < result.scores.size(); ++i)
    for (std::size_t k = 0; k < result.plan.families.size(); ++k) {
      const Score& s = result.scores[i][k];
      JsonObject object(out);
      object.text("tracer", result.plan.tracers[i]->info().name);
      object.text("family", name(result.plan.families[k]));
      object.text("inputs", name(result.plan.inputs));
      object.number("cases", static_cast<double>(s.cases));
      object.number("false_misses", static_cast<double>(s.false_misses));
      object.number("false_hits", static_cast<double>(s.false_hits));
      object.number("unspecified", static_cast<double>(s.unspecified));
      object.number("faults", static_cast<double>(s.faults));
      object.number("boundary", static_cast<double>(s.boundary));
      object.number("boundary_hits", static_cast<double>(s.boundary_hits));
      object.number("ray_false_misses", static_cast<double>(s.ray_false_misses));
      object.number("ray_false_hits", static_cast<double>(s.ray_false_hits));
      object.number("worst_nominal_ulps", s.worst_nominal_ulps);
      object.end_line();
    }
  for_each_duel(result, [&out](const std::string& first, const std::string& second, std::string_view family,
                               std::string_view hit_class, const Duel& duel) {
    JsonObject object(out);
    object.text("first", first);
    object.text("second", second);
    object.text("family", family);
    object.text("class", hit_class);
    object.number("differ", static_cast<double>(duel.differ));
    object.number("first_right", static_cast<double>(duel.first_right));
    object.number("second_right", static_cast<double>(duel.second_right));
    object.end_line();
  });
  return out;
}

std::string to_cases(const CompareResult& result) {
  std::string out;
  for (const auto& families : result.worst)
    for (const auto& list : families)
      for (const WrongCase& c : list) out += (out.empty() ? "" : "\n") + to_text(c.asked);
  return out;
}

}  // namespace plumbline
