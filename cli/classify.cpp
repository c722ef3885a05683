#include <fmt/format.h>

#include <cmath>

#include "case/float_bits.h"
#include "case/json_object.h"
#include "cli/stream.h"
#include "cli/verb.h"
#include "oracle/classify.h"
#include "oracle/contact.h"
#include "oracle/measure.h"

namespace plumbline {
namespace {

std::optional<double> within_range(double x) { return is_finite(x) ? std::optional(x) : std::nullopt; }

void classify_line(const CaseLine& line, bool t_exact, std::string& out) {
  const Triangle& triangle = line.asked.bag.triangles.front();
  const Ray& ray = line.asked.ray;
  const Truth truth = classify(triangle, ray);
  const auto at = measure<double>(triangle, ray);

  JsonObject object(out);
  object.member("id") += line.id;
  object.text("class", name(truth.hit_class));
  object.text("feature", truth.feature == Feature::none ? std::nullopt : std::optional(name(truth.feature)));
  object.boolean("hit", hit(triangle, ray, truth));
  object.number("t", at ? within_range(at->t) : std::nullopt);
  object.number("u", at ? within_range(at->u) : std::nullopt);
  object.number("v", at ? within_range(at->v) : std::nullopt);
  if (t_exact) object.text("t_exact", exact_t(triangle, ray));
  if (truth.invalid != Invalid::none) object.text("reason", reason(truth.invalid));
  object.end_line();
}

struct Options {
  StreamOptions stream;
  bool no_t_exact = false;
};

}  // namespace

void add_classify(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("classify", "Where each ray meets its triangle, exactly");
  auto options = std::make_shared<Options>();
  add_stream_options(*verb, options->stream);
  verb->add_flag("--no-t-exact", options->no_t_exact, "Leave out t_exact, which is long and takes time");
  verb->footer(
      std::string(question_keys) +
      "\nEach line of output answers one line of input:\n"
      "  id           as given\n"
      "  class        of the line through the ray: interior, edge, vertex, exterior, parallel, coplanar,\n"
      "               degenerate (a triangle without area), invalid (not finite, or a zero direction)\n"
      "  feature      which edge or vertex: ab, bc, ca, a, b, c, or null\n"
      "  hit          of the closed triangle in the closed range; null where a ray touches without crossing,\n"
      "               and where the case is invalid\n"
      "  t, u, v      where the line meets the plane (u: weight of b, v: of c), correctly rounded; null where it\n"
      "               doesn't, and beyond the range of binary64\n"
      "  t_exact      t as a fraction \"p/q\"\n"
      "  reason       only where invalid: why\n"
      "\nExample:\n"
      "  echo '{\"id\":1,\"triangle\":[[0,0,0],[1,0,0],[0,1,0]],\"origin\":[0.5,0,1],\"direction\":[0,0,-1]}' |\n"
      "    plumbline classify -\n"
      "  {\"id\":1,\"class\":\"edge\",\"feature\":\"ab\",\"hit\":true,\"t\":1,\"u\":0.5,\"v\":0,\"t_exact\":\"1/1\"}");
  verb->callback([options] {
    answer_lines(options->stream, [&](const CaseLines& lines, const CaseLine& line, std::string& out) {
      require_one_triangle(lines, line);
      classify_line(line, !options->no_t_exact, out);
    });
  });
}

}  // namespace plumbline
