#include "findings/pages/bag_panel.h"

#include <fmt/format.h>

#include "analysis/ask.h"
#include "case/real_text.h"
#include "findings/pages/html.h"
#include "findings/pages/picture.h"
#include "findings/pages/words.h"
#include "oracle/bag/explain_bag.h"
#include "oracle/explain.h"

namespace plumbline {
namespace {

constexpr std::size_t most_triangles = 200;  // to be drawn, and told in numbers

std::string both(double x) {
  return fmt::format("{}<br><span class=\"hex\">{}</span>", shortest_decimal(x), hexfloat(x));
}

// "triangle 0 at edge bc, triangle 1 at edge ca"
std::string first_hits(const BagTruth& truth) {
  if (truth.hits.empty()) return "it crosses no triangle";
  std::string text;
  for (std::size_t i = 0; i < truth.nearest(); ++i)
    text += fmt::format("{}triangle {} ({})", i > 0 ? ", " : "first ", truth.hits[i].triangle,
                        met_at(truth.hits[i].truth));
  return text;
}

std::string answer_words(const Answer& answer) {
  if (answer.outcome == Outcome::fault) return "no answer";
  if (answer.outcome == Outcome::miss) return "miss";
  return answer.has_t ? fmt::format("hit of triangle {}", answer.triangle) : "hit";
}

std::string said(const FindingRow& row, const BagLook& l) {
  const Answer* const answer = l.now ? &l.now->answer : nullptr;
  std::string rows = fmt::format("<tr><th scope=\"row\">answer<td>{}<td>{}</tr>",
                                 answer ? answer_words(*answer) : "not in this build", first_hits(l.truth));
  const bool given = answer && answer->outcome == Outcome::hit && answer->has_t;
  if (given || !l.truth.hits.empty())
    rows += fmt::format("<tr><th scope=\"row\">t<td class=\"n\">{}<td class=\"n\">{}</tr>",
                        given ? both(answer->t) : "", l.truth.hits.empty() ? "" : both(l.truth.hits.front().t));
  std::string text =
      table("What the tracer says and what is true",
            fmt::format("<th><th>{} says<th>the truth, t rounded", escaped(row.tracer)), rows);
  if (!l.now) return text;
  text += fmt::format("<p>The verdict: <strong>{}</strong>.{}</p>", name(l.now->judgement.verdict),
                      l.now->culling ? " Asked with one of the triangles alone it hits it: the hit is lost in its "
                                       "boxes or its traversal, not in its test of a triangle."
                                     : "");
  if (l.now->judgement.verdict == BagVerdict::correct) text += "<p><strong>This build gets it right.</strong></p>";
  if (l.now->judgement.verdict == BagVerdict::unspecified)
    text += "<p><strong>Its promises leave this open: no answer is wrong.</strong></p>";
  return text;
}

std::string in_order(const BagLook& l) {
  if (l.truth.invalid != Invalid::none)
    return fmt::format("<p>The case is invalid: {}.</p>", escaped(reason(l.truth.invalid)));
  std::string rows;
  for (const BagHit& hit : l.truth.hits)
    rows += fmt::format("<tr><td class=\"n\">{}<td class=\"n\">{}<td class=\"exact\">{}<td class=\"n\">{}<td>{}<td>{}"
                        "<td>{}</tr>",
                        hit.rank + 1, both(hit.t),
                        escaped(certificate(l.put.bag.triangles[hit.triangle], l.query).t->exact), hit.triangle,
                        met_at(hit.truth), hit.truth.det_sign < 0 ? "front" : "back", hit.owner ? "yes" : "");
  std::string text =
      rows.empty() ? "<p>The ray crosses none of the triangles.</p>"
                   : table("What the ray crosses, in order",
                           "<th class=\"n\">place<th class=\"n\">t, rounded<th>t, exactly<th class=\"n\">triangle<th>at"
                           "<th>from<th>owner",
                           rows) +
                         "<p class=\"note\">Equal places: exactly the same t. A ray turned aside infinitesimally, "
                         "always the same way, would cross those triangles that are owners.</p>";
  for (const Stretch& s : l.truth.stretches)
    text += fmt::format("<p>It touches triangle {} without crossing it ({}), for t from {} to {}.</p>", s.triangle,
                        name(s.hit_class), shortest_decimal(s.low), shortest_decimal(s.high));
  return text;
}

std::string coordinates(const BagLook& l) {
  std::string rows;
  const auto add = [&rows](const std::string& what, const Vec3& v) {
    rows += fmt::format("<tr><th scope=\"row\">{}<td class=\"n\">{}<td class=\"n\">{}<td class=\"n\">{}</tr>", what,
                        both(v.x), both(v.y), both(v.z));
  };
  add("origin", l.put.ray.origin);
  add("direction", l.put.ray.direction);
  for (std::size_t i = 0; i < l.put.bag.triangles.size(); ++i) {
    const auto& [a, b, c] = l.put.bag.triangles[i];
    add(fmt::format("{} A", i), a), add(fmt::format("{} B", i), b), add(fmt::format("{} C", i), c);
  }
  return "<details><summary>The numbers: decimal and hexadecimal</summary>" +
         table("The numbers", "<th><th class=\"n\">x<th class=\"n\">y<th class=\"n\">z", rows) +
         fmt::format("<p>The range of t is {} to {}.</p></details>", shortest_decimal(l.put.ray.t_min),
                     shortest_decimal(l.put.ray.t_max));
}

}  // namespace

BagLook look_at_several(const FoundCase& found, const Tracer* tracer) {
  BagLook l;
  l.ulps = found.ulps;
  if (!tracer) {
    l.put = found.what;
    l.query = found.what.ray;
    l.truth = bag_truth(l.put.bag.triangles, l.query);
    return l;
  }
  l.now = examine_bag(*tracer, found.what);
  l.put = l.now->put;
  l.query = l.now->query;
  l.truth = l.now->truth;
  if (l.now->wrong()) l.ulps = l.now->judgement.ulps;
  return l;
}

std::string in_short(const FindingRow& row, const BagLook& worst) {
  if (worst.ulps == 0) return "It is wrong by its own promise alone: there is no distance to measure.";
  const std::string_view what =
      row.kind == FindingKind::wrong_nearest
          ? "Between what has to be hit first and what is reported, along the ray if it crosses that, else beside it, "
            "there are"
          : "For the answer to be true the ray would have to move by";
  return fmt::format("{} <strong>{}</strong>: {}.", what, in_ulps(worst.ulps), how_bad(worst.ulps, 0));
}

std::string panel(std::string_view title, const FindingRow& row, const FoundCase& found, const BagLook& l) {
  const std::size_t triangles = l.put.bag.triangles.size();
  std::string text = fmt::format(
      "<section class=\"case\"><h2>{}</h2><p class=\"size\">{} triangles, {} significant bits in all numbers; {}</p>",
      title, triangles, found.bits, in_ulps(l.ulps));
  const bool few = triangles <= most_triangles;
  if (const Picture seen = few ? along_the_ray(l.put.bag.triangles, l.query, l.truth) : Picture(); !seen.svg.empty())
    text += fmt::format("<figure>{}<figcaption><strong>As the ray sees it.</strong> {}</figcaption></figure>",
                        seen.svg, escaped(seen.caption));
  text += "<h3>Said and true</h3>" + said(row, l) + "<h3>All that the ray meets, in order</h3>" + in_order(l);
  if (few) text += coordinates(l);
  std::string provenance;
  for (const std::string& line : found.what.provenance) provenance += "<li>" + escaped(line) + "</li>";
  if (!provenance.empty())
    text += "<details><summary>Where it comes from</summary><ul>" + provenance + "</ul></details>";
  return text + "</section>";
}

}  // namespace plumbline
