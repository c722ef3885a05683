#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "analysis/tracers.h"
#include "case/case_text.h"
#include "case/enum_names.h"
#include "case/folder.h"
#include "case/input_error.h"
#include "cli/output.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"
#include "repros/repro.h"

namespace plumbline {
namespace {

struct Options {
  std::string file, id, tracer, output = "-";
  std::vector<std::string> forms;
  ForeignOptions foreign;
};

Case case_of(const Options& options) {
  std::vector<Case> cases = read_cases(options.file);
  if (!options.id.empty()) std::erase_if(cases, [&](const Case& c) { return c.id != options.id; });
  if (cases.empty())
    throw InputError(options.id.empty() ? fmt::format("{}: no case in this file", options.file)
                                        : fmt::format("{}: no case '{}' in this file", options.file, options.id));
  if (cases.size() > 1)
    throw InputError(fmt::format("{}: {} cases in this file, and an export is of one; say which with --id",
                                 options.file, cases.size()));
  return std::move(cases.front());
}

bool is_program(ReproForm form) { return form < ReproForm::python_proof; }

// Whose finding it is: of those that the case's lines 'known' name, the one that the program can ask.
std::string tracer_of(const Options& options, const Case& c, ReproForm form) {
  if (!options.tracer.empty()) {
    if (absent_tracer_named(options.tracer)) return options.tracer;
    return find_tracer(options.tracer, options.foreign).info().name;
  }
  std::vector<std::string> suitable;
  for (const Known& known : c.known)
    if (!is_program(form) || repro_form_of(known.tracer) == form) suitable.push_back(known.tracer);
  if (suitable.size() == 1) return suitable.front();
  if (suitable.empty() || !is_program(form)) return "";
  throw InputError(fmt::format("{}: case '{}' has several lines 'known' for {}, of {} first; say whose with --tracer",
                               options.file, c.id, name(form), suitable.front()));
}

void write(const std::string& path, const std::string& text) {
  Output output(path);
  output.write(text);
  output.finish();
}

void run(const Options& options) {
  const Case c = case_of(options);
  std::vector<std::pair<std::string, std::string>> files;  // all of them are made before one is written
  for (const std::string& word : options.forms) {
    const ReproForm form = *from_name<ReproForm>(repro_form_names, word);
    const std::string name = repro_file_name(form);
    if (std::ranges::any_of(files, [&](const auto& file) { return file.first == name; }))
      throw InputError(fmt::format("--as {}: another form is written to {} already; export it by itself", word, name));
    files.emplace_back(name, to_repro(c, form, tracer_of(options, c, form)));
  }
  if (files.size() == 1) return write(options.output, files.front().second);
  if (options.output == "-") throw InputError("several forms: say in which folder they go, with -o DIR");
  make_folder(options.output);
  for (const auto& [name, text] : files) write((std::filesystem::path(options.output) / name).string(), text);
}

}  // namespace

void add_export(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("export", "A finding as a program, a proof or a scene that needs nothing of ours");
  auto options = std::make_shared<Options>();
  Options& o = *options;
  verb->add_option("CASE", o.file, "A .case file; '-' is standard input")->required();
  verb->add_option("--as", o.forms, "What to write, see below; repeatable: then -o names a folder")
      ->required()
      ->expected(1)
      ->take_all()
      ->check(CLI::IsMember(std::vector<std::string>(repro_form_names.begin(), repro_form_names.end())))
      ->type_name("FORM");
  verb->add_option("--id", o.id, "The case of this id; needed where the file has several")->type_name("ID");
  verb->add_option("--tracer", o.tracer, "Who gets it wrong (default: the one that the case's line 'known' names)")
      ->type_name("NAME");
  verb->add_option("-o,--output", o.output, "Where it goes; a file appears whole or not at all")
      ->type_name("FILE|DIR")
      ->capture_default_str();
  add_tracer_timeout(*verb, o.foreign);
  verb->footer(
      "What a maintainer can run. Each names at its top what is wrong, how to build it, the exact truth, the margin, "
      "and the\n"
      "contract under which the answer is wrong. Numbers lose no bit.\n"
      "  cpp-embree, cpp-cgal, cpp-bullet, cpp-glm, js-three, c-librt\n"
      "                asks that library as the tracer does (its flags, instruction set, packet; its kernel, its "
      "precision);\n"
      "                a tracer of another library, or none, stands for the library's usual call\n"
      "  cpp-plain     a textbook kernel written out: moller_trumbore, woop_watertight, plucker, baldwin_weber "
      "(_f32, _f64)\n"
      "  c-plugin      loads your shared library and asks it in one process, for the debugger\n"
      "  python-proof  proves in exact fractions what is true, with Python alone, and says what was said; like the "
      "scenes,\n"
      "                of several triangles too\n"
      "  obj, ply, asc the triangles and the ray for a viewer, a mesh reader, BRL-CAD's asc2g\n"
      "A program exits with 1 while the answer is wrong, with 0 once it is right, with 2 if it could not ask. A "
      "proof exits with\n"
      "0 if every step holds. docs/repros.md shows the build commands.\n\n" +
      std::string(foreign_tracers_help) +
      "\nExample:\n"
      "  plumbline fuzz --tracer embree_robust --runs 100000 -o embree\n"
      "  plumbline export embree/findings/false-hit-ab-nominal-c1.case --as cpp-embree -o repro.cpp\n"
      "  g++ -std=c++17 repro.cpp -lembree3 -o repro && ./repro");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
