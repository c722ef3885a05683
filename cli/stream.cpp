#include "cli/stream.h"

#include <fmt/format.h>

#include "cli/output.h"

namespace plumbline {

void add_stream_options(CLI::App& verb, StreamOptions& options) {
  verb.add_option("FILE", options.input, "NDJSON, one case a line; '-' is standard input")->required();
  verb.add_option("-o,--output", options.output, "Where the answers go; a file appears whole or not at all")
      ->type_name("FILE")
      ->capture_default_str();
}

std::size_t answer_lines(const StreamOptions& options, const LineAnswerer& answer) {
  CaseLines lines(options.input);
  Output output(options.output);
  std::size_t count = 0;
  std::string out;
  for (CaseLine line; lines.next(line); ++count) {
    answer(lines, line, out);
    output.write(out);
    out.clear();
    if (!lines.ready()) output.flush();
  }
  output.finish();
  return count;
}

void require_one_triangle(const CaseLines& lines, const CaseLine& line) {
  const auto size = line.asked.bag.triangles.size();
  if (size != 1) lines.fail(fmt::format("{} triangles; this verb takes one a case", size));
}

}  // namespace plumbline
