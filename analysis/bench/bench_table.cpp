#include "analysis/bench/bench_table.h"

#include <fmt/format.h>

#include <thread>

#include "analysis/bench/machine.h"
#include "analysis/text_table.h"
#include "case/case_text.h"
#include "case/json_object.h"

namespace plumbline {
namespace {

std::string case_text(const WorstCase& worst) {
  Case found;
  found.id = "worst_found";
  found.provenance = {fmt::format("the slowest of {} tried: {:.0f} ns", worst.tried, worst.ns)};
  found.bag.triangles = {worst.shot.triangle};
  found.ray = worst.shot.ray;
  return to_text(found);
}

std::string three_digits(double x) {
  return fmt::format(fmt::runtime(x < 10 ? "{:.2f}" : x < 100 ? "{:.1f}" : "{:.0f}"), x);
}

TextTable table_of(const BenchResult& result) {
  TextTable table{.columns = {{"workload"},
                              {"method"},
                              {"ns", true},
                              {"/ naive batch", true},
                              {"/ naive scalar", true},
                              {"undecided %", true},
                              {"wrong", true},
                              {"of", true},
                              {"answers"}},
                  .rows = {}};
  for (const BenchRow& row : result.rows)
    table.rows.push_back({row.workload, row.method, three_digits(row.ns_median), three_digits(row.ratio_to_naive_batch),
                          three_digits(row.ratio_to_naive_scalar),
                          row.undecided ? fmt::format("{:.1f}", 100 * *row.undecided) : "", std::to_string(row.wrong),
                          std::to_string(row.cases),
                          fmt::format("{}{}", name(row.answers), row.exact ? "" : ", inexact")});
  return table;
}

}  // namespace

std::string to_terminal(const BenchResult& result, const std::string& command) {
  std::string text = fmt::format("machine   {}, {} threads\nisa       {}\ncompiler  {}\ncommand   {}\n\n", processor(),
                                 std::thread::hardware_concurrency(), name(result.plan.isa), compiler(), command);
  if (!result.rows.empty()) {
    text += to_terminal(table_of(result));
    text += fmt::format(
        "\nns: processor time per case, median of {} interleaved repetitions; ratios: medians of those within one "
        "round.\n"
        "undecided: what the row's first stage leaves to the next. wrong: answers that differ from mpq_class's.\n",
        result.plan.rounds);
  }
  if (result.worst)
    text += fmt::format("\nAny finite doubles, worst found by search: {:.0f} ns for a single call{}\n{}",
                        result.worst->ns, result.worst_is_wrong ? ", answered WRONG" : "", case_text(*result.worst));
  return text;
}

std::string to_json_lines(const BenchResult& result) {
  std::string out;
  const auto open = [&](std::string_view workload, std::string_view method) {
    JsonObject object(out);
    object.text("workload", workload);
    object.text("method", method);
    object.text("isa", name(result.plan.isa));
    return object;
  };
  for (const BenchRow& row : result.rows) {
    JsonObject object = open(row.workload, row.method);
    object.number("t_max", result.plan.t_max);
    object.text("answers", name(row.answers));
    object.boolean("exact", row.exact);
    object.number("cases", static_cast<double>(row.cases));
    object.number("ns_median", row.ns_median);
    object.number("ratio_to_naive_batch", row.ratio_to_naive_batch);
    object.number("ratio_to_naive_scalar", row.ratio_to_naive_scalar);
    object.number("undecided", row.undecided);
    object.number("wrong", static_cast<double>(row.wrong));
    object.end_line();
  }
  if (result.worst) {
    JsonObject object = open("worst_found", "exact_single");
    object.number("t_max", result.worst->shot.ray.t_max);
    object.text("answers", name(Answers::truth));
    object.boolean("exact", true);
    object.number("cases", 1);
    object.number("ns_median", result.worst->ns);
    object.number("ratio_to_naive_batch", std::nullopt);
    object.number("ratio_to_naive_scalar", std::nullopt);
    object.number("undecided", std::nullopt);
    object.number("wrong", result.worst_is_wrong ? 1 : 0);
    object.number("tried", static_cast<double>(result.worst->tried));
    object.text("case", case_text(*result.worst));
    object.end_line();
  }
  return out;
}

}  // namespace plumbline
