#include "findings/pages/finding_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "analysis/found_case.h"
#include "analysis/tracers.h"
#include "case/case_text.h"
#include "case/float_bits.h"
#include "case/input_error.h"
#include "case/real_text.h"
#include "case/shell_word.h"
#include "findings/pages/bag_panel.h"
#include "findings/pages/html.h"
#include "findings/pages/look.h"
#include "findings/pages/picture.h"
#include "findings/pages/templates.h"
#include "findings/pages/words.h"

namespace plumbline {
namespace {

// An odd integer over or times a power of two: 5/2^3, 3*2^7.
std::string exact_fraction(double x) {
  if (!is_finite(x)) return shortest_decimal(x);
  if (is_zero(x)) return "0";
  using F = FloatFormat<double>;
  auto integer = static_cast<std::int64_t>(to_bits(x) & F::fraction_mask);
  if ((to_bits(x) & F::exponent_mask) != 0) integer += F::fraction_mask + 1;
  int exponent = ulp_exponent(x) + std::countr_zero(static_cast<std::uint64_t>(integer));
  integer >>= std::countr_zero(static_cast<std::uint64_t>(integer));
  if (is_negative(x)) integer = -integer;
  if (exponent == 0) return std::to_string(integer);
  if (exponent > 0)
    return exponent < 10 ? std::to_string(integer << exponent) : fmt::format("{} · 2^{}", integer, exponent);
  exponent = -exponent;
  return exponent < 10 ? fmt::format("{}/{}", integer, 1 << exponent) : fmt::format("{}/2^{}", integer, exponent);
}

std::string copied(std::string_view label, std::string_view id, std::string_view text) {
  return fmt::format(
      "<div class=\"copied\"><div class=\"bar\"><span>{0}</span><button type=\"button\" class=\"copy\" "
      "data-copy=\"{1}\" "
      "aria-label=\"Copy: {0}\">Copy</button></div><pre id=\"{1}\" tabindex=\"0\">{2}</pre></div>",
      escaped(label), id, escaped(text));
}

struct NamedNumber {
  const char* name;
  double value;
};

std::array<NamedNumber, 17> numbers_of(const Look& l) {
  const auto& [a, b, c] = l.triangle;
  const auto& [o, d, t_min, t_max] = l.given;
  return {{{"A x", a.x},
           {"A y", a.y},
           {"A z", a.z},
           {"B x", b.x},
           {"B y", b.y},
           {"B z", b.z},
           {"C x", c.x},
           {"C y", c.y},
           {"C z", c.z},
           {"origin x", o.x},
           {"origin y", o.y},
           {"origin z", o.z},
           {"direction x", d.x},
           {"direction y", d.y},
           {"direction z", d.z},
           {"range start", t_min},
           {"range end", t_max}}};
}

std::string coordinates(const Look& l) {
  std::string rows, fractions;
  for (const auto& [name, value] : numbers_of(l)) {
    rows += fmt::format("<tr><th scope=\"row\">{}", name) + number_cell(shortest_decimal(value)) +
            number_cell(hexfloat(value)) + "</tr>";
    fractions += fmt::format("<tr><th scope=\"row\">{}", name) + number_cell(exact_fraction(value)) + "</tr>";
  }
  return "<details><summary>The numbers: decimal and hexadecimal</summary>" +
         table("The numbers", "<th><th class=\"n\">decimal<th class=\"n\">hexfloat", rows) +
         "</details><details><summary>The numbers as exact fractions</summary>" +
         table("The numbers as exact fractions", "<th><th class=\"n\">exactly", fractions) + "</details>";
}

std::string sign_word(int sign) { return sign > 0 ? "+" : sign < 0 ? "−" : "0"; }

std::string proof(const Look& l) {
  const Certificate& c = l.certificate;
  if (c.truth.hit_class == HitClass::invalid) return fmt::format("<p>The case is invalid: {}.</p>", escaped(c.where));
  const auto row = [](std::string_view name, const ExactNumber& x, std::string_view meaning) {
    return fmt::format("<tr><th scope=\"row\">{}<td class=\"sign\">{}<td>{}<td class=\"exact\">{}</tr>", name,
                       sign_word(x.sign), escaped(meaning), escaped(x.exact));
  };
  const int det = c.det.sign;
  const auto of_side = [&](const ExactNumber& w) {
    return det == 0 ? std::string_view("det is 0: no crossing to place") : side(w.sign, det);
  };
  std::string rows = row("w<sub>AB</sub>", c.w_ab, of_side(c.w_ab)) + row("w<sub>BC</sub>", c.w_bc, of_side(c.w_bc)) +
                     row("w<sub>CA</sub>", c.w_ca, of_side(c.w_ca)) +
                     row("det", c.det,
                         det == 0  ? "the line is parallel to the plane"
                         : det < 0 ? "it comes from the front"
                                   : "it comes from the back") +
                     row("T", c.T,
                         det == 0 ? (c.T.sign == 0 ? "the origin is in the plane" : "the origin is off the plane")
                                  : "t = T/det: " + c.range);
  return table("The proof", "<th><th>sign<th>meaning<th>exact value", rows) +
         fmt::format(
             "<p class=\"note\">A hit: all three w have the sign of det, or are 0 on the edge itself, and T/det lies "
             "in the range.</p>"
             "<p>Here {}{}.</p>",
             escaped(c.where),
             !c.hit   ? "; whether a contact without a crossing is a hit is a matter of convention"
             : *c.hit ? "; within the range of t, so it is a hit"
                      : ", and so it is a miss");
}

std::string duty_word(Duty duty) {
  return duty == Duty::hit ? "must be a hit" : duty == Duty::miss ? "must be a miss" : "may be either";
}

std::string outcome_word(Outcome outcome) {
  return outcome == Outcome::hit ? "hit" : outcome == Outcome::miss ? "miss" : "fault";
}

std::string both(double x) {
  return fmt::format("{}<br><span class=\"hex\">{}</span>", shortest_decimal(x), hexfloat(x));
}

std::string truth_word(const Certificate& c) {
  const std::string where = std::string(name(c.truth.hit_class)) +
                            (c.truth.feature == Feature::none ? "" : " " + std::string(name(c.truth.feature)));
  return (!c.hit ? "open" : *c.hit ? "hit" : "miss") + (" (" + where + ")");
}

// What was said beside what is true.
std::string said(const FindingRow& row, const Look& l) {
  const Certificate& c = l.certificate;
  const bool answered = l.answer.has_value();
  std::string rows =
      fmt::format("<tr><th scope=\"row\">answer<td>{}<td>{}<td>{}</tr>",
                  answered ? outcome_word(l.answer->outcome) : "not in this build", truth_word(c), duty_word(l.duty));
  const auto number = [&](std::string_view name, bool given, double value, const std::optional<ExactRatio>& exact,
                          double scale) {
    if (!given && !exact) return;
    const double off = given && exact && l.margins ? std::abs(value - exact->binary64) * scale / l.margins->ulp : 0;
    rows += fmt::format("<tr><th scope=\"row\">{}<td class=\"n\">{}<td class=\"n\">{}<td>{}</tr>", name,
                        given ? both(value) : "", exact ? both(exact->binary64) : "",
                        !given || !exact || !l.margins ? ""
                        : is_finite(value)             ? "off by " + in_ulps(off)
                                                       : "not finite");
  };
  const Answer none;
  const Answer& a = answered ? *l.answer : none;
  const Margins m = l.margins.value_or(Margins{});
  number("t", a.has_t, a.t, c.t, m.t_scale);
  number("u (of B)", a.has_uv, a.u, c.u, m.u_scale);
  number("v (of C)", a.has_uv, a.v, c.v, m.v_scale);
  std::string text =
      table("What the tracer says and what is true",
            fmt::format("<th><th>{} says<th>the truth, rounded<th>by its promises", escaped(row.tracer)), rows);
  if (answered && !l.signature) text += "<p><strong>This build gets it right.</strong></p>";
  if (l.own_query)
    text +=
        "<p>The tracer’s interface can’t hold this ray: what it was really asked is a ray nearby, and it is judged "
        "on that one. <code>plumbline explain</code> shows it.</p>";
  return text;
}

std::string conditions(const Look& l) {
  if (!l.margins) return "";
  const auto row = [](std::string_view name, std::string_view meaning, double value) {
    return fmt::format("<tr><th scope=\"row\">{}<td>{}<td class=\"n\">{}<td>{}</tr>", name, meaning,
                       short_number(value), value < 0x1p-10 ? "below 1/1024: ill-conditioned" : "fine");
  };
  return "<details><summary>Condition: how hard the case is</summary>" +
         table("Condition numbers", "<th><th>what it is<th class=\"n\">value<th>",
               row("grazing", "sine of the angle between ray and plane", l.margins->sine) +
                   row("sliver", "least altitude / longest edge", l.margins->altitude) +
                   row("far", "longest edge / largest coordinate", l.margins->size)) +
         "</details>";
}

std::string figures(const FindingRow& row, const Look& l) {
  std::string text;
  const auto add = [&text](std::string_view title, const Picture& picture) {
    if (picture.svg.empty()) return;
    text += fmt::format("<figure>{}<figcaption><strong>{}</strong> {}</figcaption></figure>", picture.svg, title,
                        escaped(picture.caption));
  };
  add("The disagreement.", disagreement(row, l));
  add("The whole.", whole_triangle(row, l));
  return text.empty() ? "" : "<div class=\"figures\">" + text + "</div>";
}

// What the finding comes to, by its worst case.
std::string in_short(const FindingRow& row, const Look& worst) {
  if (row.kind == FindingKind::not_finite || row.kind == FindingKind::death) return "";
  if (worst.ulps == 0) return "It is wrong by its own promise alone: there is no distance to measure.";
  const std::string_view what = row.kind == FindingKind::displaced
                                    ? row.element == Element::plane
                                          ? "The point that it answers is off the plane by"
                                          : "Measured towards the edges, the point that it answers is off by"
                                    : "For the answer to be true the ray would have to move by";
  return fmt::format("{} <strong>{}</strong>: {}.", what, in_ulps(worst.ulps),
                     how_bad(worst.ulps, worst.longest_edge_ulps));
}

std::string neighbours(const Look& l) {
  if (!l.neighbours) return "";
  const auto [asked, wrong] = *l.neighbours;
  const std::string_view sense = wrong == 0              ? "it stands alone"
                                 : wrong * 3 < asked     ? "it is one of a few"
                                 : wrong * 3 < asked * 2 ? "it lies in a region of wrong answers, near its border"
                                                         : "it lies amid a region of wrong answers";
  return fmt::format(
      "<p>Of the {} cases beside it, one ulp away in one number, <strong>{}</strong> are wrong too: {}.</p>", asked,
      wrong, sense);
}

std::string panel(std::string_view title, const FindingRow& row, const FoundCase& found, const Look& l) {
  std::string text = fmt::format(
      "<section class=\"case\"><h2>{}</h2><p class=\"size\">{} significant bits in all its numbers; {}</p>", title,
      found.bits, in_ulps(l.ulps));
  text += figures(row, l);
  text += "<h3>Said and true</h3>" + said(row, l) + "<h3>Proof</h3>" + proof(l) + neighbours(l) + conditions(l) +
          coordinates(l);
  std::string provenance;
  for (const std::string& line : found.what.provenance) provenance += "<li>" + escaped(line) + "</li>";
  if (!provenance.empty())
    text += "<details><summary>Where it comes from</summary><ul>" + provenance + "</ul></details>";
  return text + "</section>";
}

std::string opinion(const OtherOpinion& o) {
  const char* mark = "";
  const char* style = "";
  std::string words;
  switch (o.verdict) {
    case VerdictKind::correct: mark = "✓", words = "right", style = "right"; break;
    case VerdictKind::false_miss:
    case VerdictKind::false_hit:
    case VerdictKind::leak:
    case VerdictKind::wrong_nearest:
      mark = "✗", style = "wrong", words = o.ulps > 0 ? "wrong by " + in_ulps(o.ulps) : "wrong by its own rule";
      break;
    case VerdictKind::unspecified: mark = "–", words = "either will do"; break;
    case VerdictKind::fault: mark = "!", words = "no answer"; break;
  }
  std::string text = fmt::format("<td class=\"{}\"><span aria-hidden=\"true\">{}</span> {}, {}", style, mark,
                                 outcome_word(o.outcome), words);
  if (o.rounded) text += " <sup>r</sup>";
  if (o.own_query) text += " <sup>q</sup>";
  return text;
}

// Who of this build gets it right, the finding's tracer first.
std::string matrix(const FindingRow& row, const std::vector<const FoundCase*>& cases,
                   const std::vector<std::string>& titles, const PageOptions& options) {
  std::vector<std::vector<OtherOpinion>> columns;
  for (const FoundCase* const found : cases) columns.push_back(opinions(found->what, options.tracers));
  std::string rows, head = "<th>tracer<th>precision", sums;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto wrong_ones = std::ranges::count_if(columns[k], [](const OtherOpinion& o) { return wrong(o.verdict); });
    head += "<th>" + titles[k];
    sums += fmt::format("{}{} of {} on the {}", k > 0 ? ", " : "", wrong_ones, columns[k].size(), titles[k]);
  }
  std::string self, first;  // then the others that are wrong
  for (std::size_t i = 0; i < options.tracers.size(); ++i) {
    const TracerInfo& info = options.tracers[i]->info();
    const bool any_wrong = std::ranges::any_of(columns, [i](const auto& column) { return wrong(column[i].verdict); });
    std::string& into = info.name == row.tracer ? self : any_wrong ? first : rows;
    into += fmt::format("<tr{}><th scope=\"row\">{}<td>{}", info.name == row.tracer ? " class=\"self\"" : "",
                        escaped(info.name), name(info.contract.precision));
    for (const auto& column : columns) into += opinion(column[i]);
    into += "</tr>";
  }
  return fmt::format(
      "<section><h2>What other tracers say</h2><p>Wrong are {}. Each is judged by its own promises.</p>{}"
      "<p class=\"note\"><sup>r</sup> the case was rounded to the tracer’s precision first, and is another one. "
      "<sup>q</sup> the tracer’s "
      "interface can’t hold the ray: it was asked one nearby, and is judged on that.</p></section>",
      sums, table("Tracers", head, self + first + rows, "scroll tall"));
}

constexpr std::array<const char*, repro_form_names.size()> repro_titles = {
    "C++, self-contained",    "C++ with Embree",
    "C++ with CGAL",          "C++ with Bullet",
    "C++ with GLM",           "JavaScript with three.js",
    "C with BRL-CAD’s librt", "C with your shared library",
    "Proof in Python, with fractions alone",
    "Scene as OBJ",           "Scene as PLY",
    "Scene as BRL-CAD asc"};

std::string repros(const FindingRow& row, const PageOptions& options) {
  if (!options.repro) return "";
  std::string text;
  for (std::size_t k = 0; k < repro_form_names.size(); ++k)
    if (const auto program = options.repro(row.simplest.what, static_cast<ReproForm>(k), row.tracer))
      text += fmt::format("<details><summary>{}</summary>", repro_titles[k]) +
              copied(repro_titles[k], fmt::format("repro-{}", repro_form_names[k]), *program) + "</details>";
  return text.empty() ? "" : "<h3>The simplest case as a program, a proof, a scene</h3>" + text;
}

// With an id and a line `known` that .case text can hold, whatever the finding's are.
std::string case_text(const FindingRow& row, const FoundCase& found, std::string_view id) {
  Case told = found.what;
  told.id = id;
  for (std::string& line : told.provenance)
    std::ranges::replace_if(
        line, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  set_known(told, row.tracer, row.kind);
  try {
    return to_text(told);
  } catch (const InputError&) {
    told.provenance.clear();  // what text can't hold
    return to_text(told);
  }
}

std::string explain_command(const Look& l, std::string_view tracer) {
  const auto& [a, b, c] = l.triangle;
  const auto& [o, d, t_min, t_max] = l.given;
  std::string text = "plumbline explain --triangle";
  const auto add = [&text](double x) { text += " " + hexfloat(x); };
  const auto add_vector = [&](const Vec3& v) { add(v.x), add(v.y), add(v.z); };
  add_vector(a), add_vector(b), add_vector(c);
  text += " --ray";
  add_vector(o), add_vector(d);
  text += " --range";
  add(t_min), add(t_max);
  return text + " --tracer " + shell_word(tracer);
}

std::string when(const std::string& utc) { return utc.empty() ? "unknown" : escaped(utc); }

std::string link(const FindingRow& row, std::string_view words) {
  return fmt::format("<a href=\"{}\">{}</a>", page_name(row.id, "html"), words);
}

std::string status(std::span<const FindingRow* const> ranks, const FindingRow& row) {
  if (row.status != FindingStatus::duplicate) return std::string(name(row.status));
  const auto of = std::ranges::find(ranks, row.duplicate_of, [](const FindingRow* r) { return r->id; });
  const std::string number = std::to_string(row.duplicate_of);
  return "duplicate of " + (of == ranks.end() ? number : link(**of, number));
}

std::string facts(std::span<const FindingRow* const> ranks, const FindingRow& row, const Tracer* tracer) {
  std::string text = "<dl class=\"facts\">";
  const auto fact = [&text](std::string_view name, std::string_view html) {
    text += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, html);
  };
  fact("Status", status(ranks, row));
  fact("Kind", name(row.kind));
  if (const std::size_t triangles = row.worst.what.bag.triangles.size(); triangles > 1)
    fact("Triangles", std::to_string(triangles));
  else
    fact("Where", part_name(row.element));
  fact("Condition", name(row.conditioning));
  fact("Seen", fmt::format("{} {}", row.count, row.count == 1 ? "time" : "times"));
  fact("First seen", when(row.first_seen));
  fact("Last seen", when(row.last_seen));
  fact("Signature", "<code>" + escaped(row.signature) + "</code>");
  if (tracer) {
    const TracerInfo& info = tracer->info();
    fact("Tracer", escaped(info.summary) + (info.package.empty() ? "" : " (" + escaped(info.package) + ")"));
    fact("Source", escaped(info.source));
    fact("It promises", fmt::format("{} inputs; edges {}; t range {}", name(info.contract.precision),
                                    name(info.contract.edges), name(info.contract.range)));
  } else {
    fact("Tracer", "not in this build: what it said can’t be asked again");
  }
  std::string builds;
  for (const std::string& build : row.builds) builds += (builds.empty() ? "" : "<br>") + escaped(build);
  if (!builds.empty()) fact("Builds", builds);
  return text + "</dl>";
}

std::string related(std::span<const FindingRow* const> ranks, const FindingRow& row) {
  std::string items;
  unsigned count = 0;
  for (const FindingRow* const other : ranks)
    if (other != &row && other->tracer == row.tracer && other->kind == row.kind && ++count <= 12)
      items +=
          fmt::format("<li>{}, {}</li>", link(*other, fmt::format("{}: {}", other->id, escaped(other->signature))),
                      in_ulps(other->worst.ulps));
  if (count > 12) items += fmt::format("<li>and {} more in the list</li>", count - 12);
  if (items.empty()) return "";
  return fmt::format("<section><h2>Of the same tracer and kind</h2><ul>{}</ul></section>", items);
}

std::string navigation(std::span<const FindingRow* const> ranks, std::size_t rank) {
  std::string text = "<a href=\"index.html\">All findings</a>";
  if (rank > 0) text += link(*ranks[rank - 1], fmt::format("← worse: {}", ranks[rank - 1]->id));
  if (rank + 1 < ranks.size()) text += link(*ranks[rank + 1], fmt::format("less bad: {} →", ranks[rank + 1]->id));
  return text;
}

}  // namespace

std::string page_name(std::int64_t id, std::string_view extension) {
  return fmt::format("finding-{}.{}", id, extension);
}

FindingFiles finding_files(std::span<const FindingRow* const> ranks, std::size_t rank, const PageOptions& options) {
  const FindingRow& row = *ranks[rank];
  const auto found =
      std::ranges::find_if(options.tracers, [&](const Tracer* t) { return t->info().name == row.tracer; });
  const Tracer* const tracer = found == options.tracers.end() ? nullptr : *found;
  const auto same_numbers =
      row.simplest.what.bag == row.worst.what.bag && row.simplest.what.ray == row.worst.what.ray;
  std::vector<const FoundCase*> cases = {&row.worst};
  std::vector<std::string> titles = {same_numbers ? "only case kept" : "worst case"}, ids = {"worst"};
  if (!same_numbers) {
    cases.insert(cases.begin(), &row.simplest);
    titles.insert(titles.begin(), "simplest case");
    ids.insert(ids.begin(), "simplest");
  }
  const std::string name = tracer ? asked_for(*tracer) : row.tracer;
  const std::string file = page_name(row.id, "case"), who = shell_word(name);
  const bool several = row.worst.what.bag.triangles.size() > 1;
  FindingFiles files;
  std::string panels, commands, lead;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    if (several) {
      const BagLook l = look_at_several(*cases[k], tracer);
      lead = in_short(row, l);  // the worst comes last
      panels += panel("The " + titles[k], row, *cases[k], l);
      commands += copied(fmt::format("Explain the {}", titles[k]), "explain-" + ids[k],
                         fmt::format("plumbline explain {} --id finding-{}-{} --tracer {}", file, row.id, ids[k], who));
    } else {
      const Look l = look(*cases[k], row.kind, tracer);
      lead = in_short(row, l);
      panels += panel("The " + titles[k], row, *cases[k], l);
      commands += copied(fmt::format("Explain the {}, no file needed", titles[k]), "explain-" + ids[k],
                         explain_command(l, name));
    }
    files.cases += (k > 0 ? "\n" : "") + case_text(row, *cases[k], fmt::format("finding-{}-{}", row.id, ids[k]));
  }
  commands += copied("Ask again", "replay", fmt::format("plumbline replay {} --tracer {}", file, who));
  if (!several)
    commands += copied("Make it simpler", "shrink",
                       fmt::format("plumbline shrink {} --id finding-{}-worst --tracer {}", file, row.id, who));
  const std::string wrong = what_is_wrong(row);
  const std::string body =
      fmt::format(
          "<nav class=\"pages\" aria-label=\"Findings\">{}</nav><main id=\"main\"><p class=\"kicker\">Finding "
          "{}{}</p><h1><code>{}</code> {}</h1>",
          navigation(ranks, rank), row.id, row.is_new ? " · new" : "", escaped(row.tracer), escaped(wrong)) +
      (lead.empty() ? "" : "<p class=\"lead\">" + lead + "</p>") + facts(ranks, row, tracer) +
      "<div class=\"cases\">" + panels + "</div>" + matrix(row, cases, titles, options) +
      "<section><h2>To reproduce it</h2>" + commands +
      copied(fmt::format("The cases as text, also in {}", file), "case-text", files.cases) + repros(row, options) +
      "</section>" + related(ranks, row) + "</main>";
  files.page = filled(finding_html, {{"title", escaped(fmt::format("Finding {}: {} {}", row.id, row.tracer, wrong))},
                                     {"style", page_css},
                                     {"script", finding_js},
                                     {"body", body}});
  return files;
}

}  // namespace plumbline
