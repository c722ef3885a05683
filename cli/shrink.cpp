#include <fmt/format.h>

#include "analysis/shrink.h"
#include "case/case_text.h"
#include "case/enum_names.h"
#include "case/input_error.h"
#include "case/precision.h"
#include "cli/output.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

struct Options {
  std::string file, id, tracer, keep = "nominal", output = "-";
  ForeignOptions foreign;
};

std::string tracer_of(const Options& options, const Case& c) {
  if (!options.tracer.empty()) return options.tracer;
  if (c.known.size() == 1) return c.known.front().tracer;
  throw InputError(fmt::format("{}: case '{}' has {}; say whose with --tracer", options.file, c.id,
                               c.known.empty() ? "no line 'known'" : "several lines 'known'"));
}

FuzzInput input_of(const Options& options, const Case& c, Precision precision) {
  if (c.aim)
    if (const auto input = from_case(c, Space::target, precision)) return *input;
  if (const auto input = from_case(c, Space::ray, precision)) return *input;
  throw InputError(fmt::format("{}: case '{}' is not one triangle with numbers of {}; shrink takes no other", options.file,
                               c.id, name(precision)));
}

std::string told(const Examination& e, unsigned bits) {
  const auto s = signature(e);
  return fmt::format("{:4} significant bits, severity {:.4g} ulps, {}\n", bits, e.severity_ulps(), s ? to_word(*s) : "");
}

void run(const Options& options) {
  const Keep keep = *from_name<Keep>(keep_names, options.keep);
  Output output(options.output);
  bool any = false;
  for (const Case& c : read_cases(options.file)) {
    if (!options.id.empty() && c.id != options.id) continue;
    any = true;
    const Tracer& tracer = find_tracer(tracer_of(options, c), options.foreign);
    const std::string& who = tracer.info().name;
    const auto shrunk = shrink(input_of(options, c, tracer.info().contract.precision), tracer, keep);
    if (!shrunk) throw InputError(fmt::format("{}: {} gets case '{}' right; nothing to shrink", options.file, who, c.id));
    Case simple = to_case(shrunk->input);
    simple.id = c.id;
    simple.provenance = c.provenance;
    simple.provenance.push_back(fmt::format("shrunk for {} ({}): {} -> {} significant bits", who, name(keep),
                                            shrunk->bits_before, shrunk->bits_after));
    simple.known = c.known;
    output.write(to_text(simple));
    fmt::print(stderr, "{}: {}\n  before {}  after  {}", c.id, who, told(shrunk->before, shrunk->bits_before),
               told(shrunk->after, shrunk->bits_after));
  }
  if (!any) throw InputError(fmt::format("{}: no case '{}' in this file", options.file, options.id));
  output.finish();
}

}  // namespace

void add_shrink(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("shrink", "Make a finding plain: the simplest case that is wrong in the same way");
  auto options = std::make_shared<Options>();
  Options& o = *options;
  verb->add_option("CASE", o.file, "A .case file; '-' is standard input")->required();
  verb->add_option("--id", o.id, "Only the case of this id (default: all of the file)")->type_name("ID");
  verb->add_option("--tracer", o.tracer, "Who gets it wrong (default: the one that the case's line 'known' names)")
      ->type_name("NAME");
  verb->add_option("--keep", o.keep, "What has to stay as it is; see below")
      ->check(CLI::IsMember(std::vector<std::string>(keep_names.begin(), keep_names.end())))
      ->type_name("WHAT")
      ->capture_default_str();
  verb->add_option("-o,--output", o.output, "Where the simpler case goes; a file appears whole or not at all")
      ->type_name("FILE")
      ->capture_default_str();
  add_tracer_timeout(*verb, o.foreign);
  verb->footer(
      "Kept in any case: the tracer, false miss or false hit, at which edge, vertex or end, and by which of its tests.\n"
      "  simple    nothing else: the shortest\n"
      "  nominal   whether it is nominal, or else grazing, a sliver, or far\n"
      "  worst     the whole signature, and at least half of the severity\n"
      "Simpler: fewer significant bits, then exponents nearer to 0 and fewer minus signs, then fewer ones. Every step is\n"
      "examined by the tracer and the oracle; the result is the same every time.\n"
      "\nExample:\n"
      "  plumbline fuzz --tracer woop_watertight_f32 --runs 100000 -o woop\n"
      "  plumbline shrink woop/findings/false-hit-ca-nominal-c1.case");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
