#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <set>
#include <span>

#include "analysis/case_forms.h"
#include "case/case_bytes.h"
#include "case/case_json.h"
#include "case/case_text.h"
#include "case/enum_names.h"
#include "case/input_error.h"
#include "cli/output.h"
#include "cli/verb.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string input, output = "-";
  std::string to = std::string(name(CaseForm::text)), space, precision, domain = std::string(name(Domain::nominal));
};

// Ids that name things have to differ.
class Ids {
 public:
  void add(const std::string& id, const std::string& file) {
    if (!seen_.insert(id).second)
      throw InputError(fmt::format("{}: a second case '{}'; rename one of them, or use --to ndjson", file, id));
  }

 private:
  std::set<std::string> seen_;
};

std::string text_of(const Case& read, const std::string& file) {
  try {
    return to_text(read);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}; or use --to ndjson", file, error.what()));
  }
}

FuzzInput input_of(const Case& read, const std::string& file, const BytesReading& bytes) {
  const Space space = bytes.space.value_or(Space::ray);
  const Precision precision = bytes.precision.value_or(read.precision);
  const auto input = from_case(read, space, precision);
  if (!input)
    throw InputError(fmt::format(
        "{}: case '{}' is no input of the {} space in {}: that takes one triangle as a surface, finite numbers of "
        "this precision{}; try another --space or --precision",
        file, read.id, name(space), name(precision),
        space == Space::target ? " and the aim that leads to the ray" : ""));
  if (!in_domain(*input, bytes.domain))
    throw InputError(fmt::format("{}: case '{}' has numbers beyond the {} domain; add --domain {}", file, read.id,
                                 name(bytes.domain), name(Domain::full)));
  return *input;
}

void write_bytes(const FuzzInput& input, const std::string& id, const std::string& folder) {
  const bool usable = !id.empty() && id != "." && id != ".." && id.find('/') == id.npos;
  if (!usable || form_of(id) != CaseForm::bytes)
    throw InputError(fmt::format("case '{}': no name for a file of bytes; rename the case", id));
  std::string bytes(input_size(input.space, input.precision), '\0');
  encode(input, std::as_writable_bytes(std::span(bytes)));
  Output output((fs::path(folder) / id).string());
  output.write(bytes);
  output.finish();
}

void to_bytes(const std::vector<std::string>& files, const BytesReading& bytes, const std::string& folder) {
  if (folder == "-") throw InputError("--to bytes writes a file for each case; add -o with a folder for them");
  fs::create_directories(folder);
  Ids ids;
  for (const std::string& file : files)
    read_any_cases(file, bytes, [&](const Case& read) {
      ids.add(read.id, file);
      write_bytes(input_of(read, file, bytes), read.id, folder);
    });
}

void to_lines(const std::vector<std::string>& files, const BytesReading& bytes, CaseForm form,
              const std::string& path) {
  Output output(path);
  Ids ids;
  std::string line;
  bool first = true;
  for (const std::string& file : files)
    read_any_cases(file, bytes, [&](const Case& read) {
      line.clear();
      if (form == CaseForm::ndjson) {
        append_json(line, read);
      } else {
        ids.add(read.id, file);
        line = (first ? "" : "\n") + text_of(read, file);
      }
      first = false;
      output.write(line);
    });
  output.finish();
}

void run(const Options& options) {
  const BytesReading bytes{.space = from_name<Space>(space_names, options.space),
                           .precision = from_name<Precision>(precision_names, options.precision),
                           .domain = *from_name<Domain>(domain_names, options.domain)};
  const CaseForm form = *from_name<CaseForm>(case_form_names, options.to);
  const std::vector<std::string> files = files_of(options.input);
  if (form == CaseForm::bytes) return to_bytes(files, bytes, options.output);
  to_lines(files, bytes, form, options.output);
}

template <std::size_t N>
CLI::Option* add_choice(CLI::App& verb, std::string name, std::string& value,
                        const std::array<std::string_view, N>& names, std::string help) {
  return verb.add_option(std::move(name), value, std::move(help))
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
}

}  // namespace

void add_convert(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("convert", "Cases into another form: .case text, NDJSON, a fuzzer's bytes");
  auto options = std::make_shared<Options>();
  Options& o = *options;
  verb->add_option("IN", o.input, "A file, or a folder: all files in it; '-' is standard input, NDJSON")->required();
  verb->add_option("-o,--output", o.output,
                   "Where the cases go; a file appears whole or not at all. Of bytes, a folder, which is made:\n"
                   "a file a case, named by its id")
      ->type_name("PATH")
      ->capture_default_str();
  add_choice(*verb, "--to", o.to, case_form_names, "Into which form")->capture_default_str();
  add_choice(*verb, "--space", o.space, space_names,
             "Of bytes that are written (default: ray), or read (default: by their number)");
  add_choice(*verb, "--precision", o.precision, precision_names,
             "The same (default: as the case says, or by their number)");
  add_choice(*verb, "--domain", o.domain, domain_names, "Of bytes: how they are read, and what may be written")
      ->capture_default_str();
  verb->footer(
      "A file is read by its name: .case as text, .ndjson and .jsonl as JSON lines, all others as bytes, an input\n"
      "of a fuzzer: little-endian numbers of its precision,\n"
      "  space ray     17: origin, direction, a, b, c, t_min, t_max; 68 or 136 bytes\n"
      "  space target  12: a, b, c, tolerance, standoff, and a whole number that says, modulo 28, which of the\n"
      "                report's targets: 4 interior, 6 vertices and midpoints of edges, 18 at the tolerance; 48 or\n"
      "                96 bytes. The ray is the one that 'plumbline sweep' fires at it\n"
      "All bytes mean a case. Numbers beyond the domain are folded into it: read with that of the fuzzer.\n"
      "  nominal       0 or 2^-40 <= |x| < 2^20 (binary32: from 2^-30), t_min also -inf, t_max also inf\n"
      "  full          all finite numbers, bounds also infinite\n"
      "\nNumbers stay as they are, bit for bit. What a form has no place for is left out: in NDJSON remarks, expect\n"
      "and known, in bytes all but these numbers.\n"
      "\nExamples:\n"
      "  plumbline convert archive -o found.case\n"
      "  plumbline convert corpus/hard/scale.case --to bytes --domain full -o seeds\n"
      "  plumbline generate lattice | plumbline convert - --to bytes --space target -o seeds");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
