// What the verbs have in common that turn NDJSON into NDJSON, a line for a line.
#pragma once
#include <CLI/CLI.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "case/case_lines.h"

namespace plumbline {

struct StreamOptions {
  std::string input, output = "-";
};

/// FILE, and --output.
void add_stream_options(CLI::App& verb, StreamOptions& options);

/// Calls `answer` for each line; it appends its own line to `out`. Returns the number of lines. Answers are passed on
/// whenever there is nothing more to read at once, so that a program may ask line by line.
using LineAnswerer = std::function<void(const CaseLines& lines, const CaseLine& line, std::string& out)>;
std::size_t answer_lines(const StreamOptions& options, const LineAnswerer& answer);

/// Fails at the line read last if its bag has not exactly one triangle.
void require_one_triangle(const CaseLines& lines, const CaseLine& line);

/// What a footer says of the input.
inline constexpr const char* question_keys =
    "Each line of FILE ('-': standard input) is one JSON object:\n"
    "  id           any string or number, echoed (default null)\n"
    "  triangle     [[x,y,z],[x,y,z],[x,y,z]]; or triangles, an array of these\n"
    "  origin       [x,y,z]\n"
    "  direction    [x,y,z], of any length but zero; t counts in lengths of it\n"
    "  t_min, t_max the closed range of t (default 0 and null = infinity); t_min \"-inf\": the whole line\n"
    "  precision    \"binary32\" or \"binary64\" (default): all numbers have to be of it\n"
    "  mode         \"surface\" (default), \"solid\", or \"plate\": then thickness (required), position \"centred\" "
    "or\n"
    "               \"appended\", and cosine true or false\n"
    "  orientation  \"none\" (default), \"ccw\" or \"cw\"\n"
    "  target, tolerance, standoff, wish   how the ray was aimed; not looked at here\n"
    "A number is a JSON number, or a string with a hexfloat (\"0x1.8p+0\"), \"inf\", \"-inf\" or \"nan\".\n"
    "A malformed line ends it all with exit code 2: standard output keeps what precedes it, a file of -o doesn't "
    "appear.\n";

}  // namespace plumbline
