#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/text_table.h"
#include "fuzz/bench/fuzz_bench.h"

namespace plumbline {
namespace {

constexpr double floor_ulps = 0.5;  // of a severity in a ratio: half an ulp is what rounding once may be off

class Runs {
 public:
  explicit Runs(const std::vector<FuzzBenchRun>& runs) : runs_(runs) {}

  template <class Value>
  Spread of(const std::string& engine, const std::string& tracer, Value value) const {
    std::vector<double> values;
    for (const FuzzBenchRun& run : runs_)
      if (run.engine == engine && run.summary.tracer == tracer) values.push_back(value(run.summary));
    return spread(values);
  }
  // At the time of the engine that took the shorter time, by medians.
  double severity_at_equal_seconds(const std::string& engine, const std::string& other, const std::string& tracer) const {
    const auto seconds = [](const Summary& s) { return s.seconds; };
    const double time = std::min(of(engine, tracer, seconds).median, of(other, tracer, seconds).median);
    return of(engine, tracer, [time](const Summary& s) { return severity_after(s, time); }).median;
  }

 private:
  const std::vector<FuzzBenchRun>& runs_;
};

double worst(const Summary& s) { return s.worst_nominal_severity; }
double ratio(double x, double y) { return std::max(x, floor_ulps) / std::max(y, floor_ulps); }
double first(const Summary& s) {
  return s.first_disagreement ? static_cast<double>(*s.first_disagreement) : std::numeric_limits<double>::infinity();
}
double rate(const Summary& s) { return s.seconds > 0 ? static_cast<double>(s.executions) / s.seconds : 0; }

std::string text(const Spread& s) { return fmt::format("{:.3g} [{:.3g}..{:.3g}]", s.median, s.least, s.most); }

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += std::log(v);
  return values.empty() ? 0 : std::exp(sum / static_cast<double>(values.size()));
}

}  // namespace

std::string to_terminal(const FuzzBenchPlan& plan, const std::vector<FuzzBenchRun>& list, const std::string& command) {
  const Runs runs(list);
  TextTable found{{{"tracer"}, {"engine"}, {"worst S_N (ulps)", true}, {"executions to first S > 0", true}, {"executions/s", true}}, {}};
  for (const std::string& tracer : plan.tracers)
    for (const std::string& engine : plan.engines)
      found.rows.push_back({tracer, engine, text(runs.of(engine, tracer, worst)), text(runs.of(engine, tracer, first)),
                            text(runs.of(engine, tracer, rate))});
  std::string out = fmt::format("{}\nmedians [least..most] over {} seeds of {} executions; S_N: severity of a nominal case\n\n{}",
                                command, plan.seeds, plan.executions, to_terminal(found));
  if (std::ranges::find(plan.engines, "elites") == plan.engines.end()) return out;

  TextTable ratios{{{"tracer"}}, {}};
  std::vector<std::string> others;
  for (const std::string& engine : plan.engines)
    if (engine != "elites") {
      others.push_back(engine);
      ratios.columns.push_back({"over " + engine, true});
      if (engine != "lattice") ratios.columns.push_back({"at equal seconds", true});
    }
  std::vector<std::vector<double>> all(ratios.columns.size() - 1);
  for (const std::string& tracer : plan.tracers) {
    std::vector<std::string> row = {tracer};
    const auto add = [&](double value) {
      all[row.size() - 1].push_back(value);
      row.push_back(fmt::format("{:.3g}", value));
    };
    for (const std::string& other : others) {
      add(ratio(runs.of("elites", tracer, worst).median, runs.of(other, tracer, worst).median));
      if (other != "lattice")
        add(ratio(runs.severity_at_equal_seconds("elites", other, tracer),
                  runs.severity_at_equal_seconds(other, "elites", tracer)));
    }
    ratios.rows.push_back(row);
  }
  std::vector<std::string> means = {"geometric mean"};
  for (const auto& column : all) means.push_back(fmt::format("{:.3g}", geometric_mean(column)));
  ratios.rows.push_back(means);
  out += fmt::format("\nelites: ratios of median worst S_N, severities below {} ulp counted as that\n\n{}", floor_ulps,
                     to_terminal(ratios));
  return out;
}

}  // namespace plumbline
