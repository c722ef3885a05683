#include <fmt/format.h>

#include "analysis/case_sources.h"
#include "case/case_json.h"
#include "case/enum_names.h"
#include "cli/number_options.h"
#include "cli/output.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

struct Options {
  std::string source, precision, output = "-";
  SourceOptions of;
};

void run(Options options) {
  if (!options.precision.empty()) options.of.precision = from_name<Precision>(precision_names, options.precision);
  Output output(options.output);
  std::string line;
  generate(options.source, options.of, [&](const Case& made) {
    line.clear();
    append_json(line, made);
    output.write(line);
  });
  output.finish();
}

}  // namespace

void add_generate(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("generate", "Cases for a tracer of your own, as JSON lines");
  auto options = std::make_shared<Options>();
  Options& o = *options;
  verb->add_option("SOURCE", o.source, "lattice, a family, a .case file or a folder of them; see below")->required();
  verb->add_option("--count", o.of.count, "At most so many cases (default: 1000 of a family, else all)")
      ->check(whole_number())
      ->type_name("N");
  verb->add_option("--seed", o.of.seed, "Of a family: the same seed gives the same cases on every machine")
      ->check(whole_number())
      ->type_name("N")
      ->capture_default_str();
  verb->add_option("--precision", o.precision,
                   "Round all numbers to it: binary32 for a tracer that reads floats (default: as they are)")
      ->check(CLI::IsMember(std::vector<std::string>(precision_names.begin(), precision_names.end())))
      ->type_name("PRECISION");
  verb->add_option("-o,--output", o.output, "Where the cases go; a file appears whole or not at all")
      ->type_name("FILE")
      ->capture_default_str();
  verb->footer(
      "SOURCE is one of:\n"
      "  lattice        the report's 21504 rays, as 'plumbline sweep' fires them, with target and wish\n"
      "  random         coordinates uniform in [-1, 1]: easy\n"
      "  small_far      small triangles far away\n"
      "  lattice_points origin, target and vertices from {0, 1.5}^3\n"
      "  exact_edge12, exact_edge23, exact_edge51   exactly through an edge or vertex, on a grid of so many bits\n"
      "  ulp12, ulp51   the same, one coordinate moved by one unit in the last place\n"
      "  coplanar       in the triangle's plane\n"
      "  degenerate     triangles without area\n"
      "  mixed40, wide, wide_edge, full_range   coordinates over many binades, up to any finite bits\n"
      "  sliver, far, grazing, edge_ulps   thin, 2^20 sizes from 0, at a grazing angle, at an edge within rounding\n"
      "  tiny, huge     where products of three under- or overflow in binary32\n"
      "  a file or folder of .case, such as corpus/hard\n\n"
      "Each line is one case, with the keys that 'plumbline judge --help' tells. Your program copies the line, adds\n"
      "\"hit\":true or false, and 'plumbline judge' says what it gets wrong. Rounded to binary32, numbers beyond its\n"
      "range become \"inf\", and the case is invalid.\n"
      "\nExamples:\n"
      "  plumbline generate exact_edge23 --precision binary32 | ./my_program | plumbline judge -\n"
      "  plumbline generate corpus/hard | python3 examples/pipe/ray_tracer.py | plumbline judge -");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
