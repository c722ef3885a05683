#include "analysis/stability_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "analysis/csv.h"
#include "analysis/text_table.h"
#include "case/real_text.h"

namespace plumbline {
namespace {

struct Measure {
  std::string_view name;
  Spread StabilityCell::*spread;
};

constexpr std::array<Measure, 11> measures = {{{"severity", &StabilityCell::severity},
                                               {"nominal_severity", &StabilityCell::nominal_severity},
                                               {"t", &StabilityCell::t},
                                               {"u", &StabilityCell::u},
                                               {"v", &StabilityCell::v},
                                               {"point", &StabilityCell::point},
                                               {"residual", &StabilityCell::residual},
                                               {"start", &StabilityCell::start},
                                               {"forward", &StabilityCell::forward},
                                               {"backward", &StabilityCell::backward},
                                               {"condition", &StabilityCell::condition}}};

std::string who(const Subject& s) {
  const TracerInfo& info = s.tracer->info();
  return fmt::format("{},{},{}", csv_field(info.name), name(info.contract.precision), name(s.inputs));
}

std::string values(const Spread& s) {
  return fmt::format("{},{},{}", shortest_decimal(s.median), shortest_decimal(s.p99), shortest_decimal(s.worst));
}

// Wilson's score interval of a share, at 95 %.
std::array<double, 2> interval(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return {0, 1};
  constexpr double z = 1.959963984540054;
  const double n = static_cast<double>(whole), p = static_cast<double>(part) / n;
  const double middle = p + z * z / (2 * n), half = z * std::sqrt((p * (1 - p) + z * z / (4 * n)) / n),
               all = 1 + z * z / n;
  return {part > 0 ? (middle - half) / all : 0, part < whole ? (middle + half) / all : 1};
}

std::string counted(std::uint64_t part, std::uint64_t whole) {
  const auto [low, high] = interval(part, whole);
  return fmt::format("{},{},{}", part, shortest_decimal(low), shortest_decimal(high));
}

template <class Line>
void for_each_dial(const StabilityResult& result, Line line) {
  for (std::size_t s = 0; s < result.plan.subjects.size(); ++s)
    for (std::size_t d = 0; d < result.plan.dials.size(); ++d)
      line(result.plan.subjects[s], result.plan.dials[d], result.cells[s][d]);
}

}  // namespace

std::string cells_csv(const StabilityResult& result) {
  std::string out =
      "tracer,precision,inputs,dial,setting,cases,hits,false_misses,false_misses_low,false_misses_high,false_hits,"
      "false_hits_low,false_hits_high,unspecified,faults,not_finite";
  for (const Measure& m : measures) out += fmt::format(",{0}_count,{0}_median,{0}_p99,{0}_worst", m.name);
  out += '\n';
  for_each_dial(result, [&](const Subject& subject, Dial dial, const std::vector<StabilityCell>& cells) {
    const std::vector<int> at = settings(dial, subject.inputs);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const StabilityCell& c = cells[i];
      const std::uint64_t judged = c.cases - c.unspecified - c.faults;
      out += fmt::format("{},{},{},{},{},{},{},{},{},{}", who(subject), name(dial), at[i], c.cases, c.hits,
                         counted(c.false_misses, c.hits), counted(c.false_hits, judged - c.hits), c.unspecified,
                         c.faults, c.not_finite);
      for (const Measure& m : measures) out += fmt::format(",{},{}", (c.*m.spread).count, values(c.*m.spread));
      out += '\n';
    }
  });
  return out;
}

std::string verdicts_csv(const StabilityResult& result) {
  std::string out =
      "tracer,precision,inputs,dial,stable,leaves_at,slope,wrong,answers,forward_p99,backward_p99,backward_worst\n";
  for_each_dial(result, [&](const Subject& subject, Dial dial, const std::vector<StabilityCell>& cells) {
    const StabilityVerdict v = verdict(settings(dial, subject.inputs), cells);
    std::uint64_t wrong = 0, answers = 0;
    double forward = 0, backward = 0, worst = 0;
    for (const StabilityCell& c : cells) {
      wrong += c.false_misses + c.false_hits;
      answers += c.cases - c.unspecified - c.faults;
      forward = std::max(forward, c.forward.p99);
      backward = std::max(backward, c.backward.p99);
      worst = std::max(worst, c.backward.worst);
    }
    out += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", who(subject), name(dial), int{v.stable},
                       v.stable ? "" : fmt::format("{}", v.leaves_at), shortest_decimal(v.slope), wrong, answers,
                       shortest_decimal(forward), shortest_decimal(backward), shortest_decimal(worst));
  });
  return out;
}

std::string symmetries_csv(const StabilityResult& result) {
  std::string out = "tracer,precision,inputs,symmetry,asked,changed\n";
  for (std::size_t s = 0; s < result.plan.subjects.size(); ++s)
    for (std::size_t i = 0; i < symmetry_names.size(); ++i)
      out += fmt::format("{},{},{},{}\n", who(result.plan.subjects[s]), symmetry_names[i],
                         result.symmetries[s][i].asked, result.symmetries[s][i].changed);
  return out;
}

std::string builds_csv(const StabilityResult& result) {
  std::string out = "tracer,variant,precision,inputs,asked,differ\n";
  for (const BuildCount& b : result.builds) {
    const Subject& base = result.plan.subjects[b.base];
    out += fmt::format("{},{},{},{}\n", csv_field(base.tracer->info().name), who(result.plan.subjects[b.variant]),
                       b.asked, b.differ);
  }
  return out;
}

std::string conditions_csv(const StabilityResult& result) {
  std::string out = "tracer,precision,inputs,log2_condition,count,median,p99,worst\n";
  for (std::size_t s = 0; s < result.plan.subjects.size(); ++s)
    for (std::size_t bin = 0; bin < condition_bins; ++bin)
      if (const Spread& t = result.conditions[s][bin]; t.count > 0)
        out += fmt::format("{},{},{},{}\n", who(result.plan.subjects[s]), bin, t.count, values(t));
  return out;
}

std::string to_terminal(const StabilityResult& result) {
  TextTable table{{{"tracer"}}, {}};
  for (const Dial dial : result.plan.dials) table.columns.push_back({std::string(name(dial)), true});
  for (std::size_t s = 0; s < result.plan.subjects.size(); ++s) {
    const Subject& subject = result.plan.subjects[s];
    if (subject.inputs != subject.tracer->info().contract.precision) continue;
    std::vector<std::string> row = {subject.tracer->info().name};
    for (std::size_t d = 0; d < result.plan.dials.size(); ++d) {
      const StabilityVerdict v = verdict(settings(result.plan.dials[d], subject.inputs), result.cells[s][d]);
      row.push_back(v.stable ? "." : fmt::format("{}", v.leaves_at));
    }
    table.rows.push_back(std::move(row));
  }
  return to_terminal(table);
}

}  // namespace plumbline
