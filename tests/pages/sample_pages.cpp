// Pages of findings that were never found, for browser_test.py: of every hostile name one, with a repro of every
// form, and many more. Arguments: a folder that is there, and how many more.
#include <cstdlib>
#include <fstream>

#include "analysis/tracers.h"
#include "findings/pages/pages.h"
#include "tests/findings/sample_rows.h"

int main(int argc, char** argv) {
  using namespace plumbline;
  if (argc != 3) return 2;
  std::vector<FindingRow> rows = many_rows(std::strtoul(argv[2], nullptr, 10));
  std::size_t hostile = 0;
  for (const std::string& name : hostile_names()) {
    FindingRow row = sample_row(static_cast<std::int64_t>(rows.size()) + 1, name);
    row.worst.ulps = 1e30;  // the first to get pages
    row.signature += "-" + name;
    row.builds = {name};
    row.worst.what.provenance = {name};
    rows.push_back(std::move(row));
    ++hostile;
  }
  const std::vector<SearchRow> searches = {{.tracer = hostile_names().front(),
                                            .source = hostile_names().back(),
                                            .ended = "2026-01-02T03:04:05Z",
                                            .executions = 1000000,
                                            .worst_nominal_ulps = 3}};
  PageOptions options;
  options.pages = hostile + 3;
  options.tracers = {tracer_named("exact")};
  options.repro = [](const Case&, ReproForm form, std::string_view tracer) {
    return std::string(name(form)) + " for " + std::string(tracer);
  };
  write_pages(rows, searches, options, [&](const std::string& name, const std::string& text) {
    std::ofstream(std::string(argv[1]) + "/" + name) << text;
  });
}
