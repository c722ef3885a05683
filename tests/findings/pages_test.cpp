#include "findings/pages/pages.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/tracers.h"
#include "case/case_text.h"
#include "case/shell_word.h"
#include "findings/pages/html.h"
#include "findings/pages/words.h"
#include "tests/analysis/fixed_tracer.h"
#include "tests/case/error_of.h"
#include "tests/findings/sample_rows.h"
#include "tests/several.h"

namespace plumbline {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct Written {
  std::vector<std::string> order;
  std::map<std::string, std::string> files;
  const std::string& operator[](const std::string& name) const { return files.at(name); }
};

Written pages_of(const std::vector<FindingRow>& rows, const std::vector<SearchRow>& searches = {},
                 const PageOptions& options = {}) {
  Written written;
  write_pages(rows, searches, options, [&](const std::string& name, const std::string& text) {
    written.order.push_back(name);
    written.files[name] = text;
  });
  return written;
}

// The page of one finding of the tracer 'fixed', which answers so.
std::string page_of(FindingRow row, const Answer& answer, const Contract& contract = {}) {
  const FixedTracer fixed({.answer = answer}, contract);
  row.tracer = "fixed";
  PageOptions options;
  options.tracers = {&fixed, tracer_named("exact")};
  return pages_of({row}, {}, options)["finding-" + std::to_string(row.id) + ".html"];
}

nlohmann::json data_of(const std::string& list) {
  const std::string mark = "<script type=\"application/json\" id=\"data\">";
  const auto from = list.find(mark) + mark.size();
  return nlohmann::json::parse(list.substr(from, list.find("</script>", from) - from));
}

std::uint64_t cell(const nlohmann::json& data, const std::string& column, std::size_t row) {
  const std::size_t width = data["columns"][column]["width"];
  const std::string digits = data["columns"][column]["digits"];
  EXPECT_EQ(digits.size(), width * data["rows"].get<std::size_t>());
  return width == 0 ? 0 : std::stoull(digits.substr(row * width, width), nullptr, 36);
}

TEST(Html, EscapesWhatHasAMeaning) {
  EXPECT_EQ(escaped("a<b>&\"c'\n\td"), "a&lt;b&gt;&amp;&quot;c&#39;\n\td");
  EXPECT_EQ(escaped(std::string_view("\0\x1f\x7f", 3)), "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
  EXPECT_EQ(json_in_html("\"</script><!--\""), "\"\\u003c/script>\\u003c!--\"");
}

TEST(Html, QuotesForTheShell) {
  EXPECT_EQ(shell_word("embree_robust"), "embree_robust");
  EXPECT_EQ(shell_word("./libmine.so"), "./libmine.so");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("pipe:./my program"), "'pipe:./my program'");
  EXPECT_EQ(shell_word("a'b$(c)"), "'a'\\''b$(c)'");
}

TEST(Html, FillsATemplateOnce) {
  EXPECT_EQ(filled("<{{a}}|{{b}}>", {{"a", "{{b}}"}, {"b", "2"}}), "<{{b}}|2>");
  EXPECT_THROW(filled("{{c}}", {{"a", "1"}}), std::logic_error);
}

TEST(Words, KeepThreeDigits) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(0.145), "0.145");
  EXPECT_EQ(short_number(99.94), "99.9");
  EXPECT_EQ(short_number(28853), "28853");
  EXPECT_EQ(short_number(1.654e14), "1.65e14");
  EXPECT_EQ(short_number(2.16e-15), "2.16e-15");
  EXPECT_EQ(in_ulps(1), "1 ulp");
}

TEST(Words, SayWhatIsWrongOfEveryKindAndElement) {
  FindingRow row = sample_row(1, "t");
  EXPECT_EQ(what_is_wrong(row), "calls this a hit; the ray passes outside edge AB");
  for (unsigned kind = 0; kind < finding_kind_names.size(); ++kind)
    for (unsigned element = 0; element < element_names.size(); ++element) {
      row.kind = static_cast<FindingKind>(kind);
      row.element = static_cast<Element>(element);
      EXPECT_NE(what_is_wrong(row), "") << kind << " " << element;
    }
  row.kind = FindingKind::false_miss;
  row.element = Element::bc;
  row.signature = "false-miss-bc-exactly-nominal-c0";
  EXPECT_EQ(what_is_wrong(row), "misses this; the ray meets edge BC exactly, where it promises a hit");
}

TEST(Pages, AHundredThousandRowsAreUnderThreeMegabytes) {
  const auto rows = many_rows(100'000);
  const std::string list = pages_of(rows, {}, {.pages = 0, .tracers = {}})["index.html"];
  EXPECT_LT(list.size(), 3'000'000u);
  const auto data = data_of(list);
  EXPECT_EQ(data["rows"], 100'000);
  // Nothing is lost on the way.
  const std::string id_digits = data["columns"]["id"]["digits"];
  std::set<std::string> ids;
  for (std::size_t k = 0; k < 100'000; ++k) ids.insert(id_digits.substr(4 * k, 4));
  EXPECT_EQ(ids.size(), 100'000u);
  for (const std::size_t k : {0u, 1u, 77'777u, 99'999u}) {
    const FindingRow& row = rows[cell(data, "id", k) - 1];
    EXPECT_EQ(data["tracers"][cell(data, "tracer", k)], row.tracer);
    const auto signature = cell(data, "signature", k);
    EXPECT_EQ(data["signatures"][signature], row.signature);
    EXPECT_THAT(
        data["classes"][signature].get<std::vector<int>>(),
        ElementsAre(static_cast<int>(row.kind), static_cast<int>(row.element), static_cast<int>(row.conditioning)));
    EXPECT_EQ(cell(data, "bits", k), row.simplest.bits);
    EXPECT_EQ(cell(data, "count", k), row.count);
    EXPECT_EQ(cell(data, "status", k), static_cast<unsigned>(row.status));
    EXPECT_EQ(cell(data, "fresh", k), row.is_new);
    EXPECT_EQ(data["days"][cell(data, "first", k)], row.first_seen.substr(0, 10));
    EXPECT_EQ(data["days"][cell(data, "last", k)], row.last_seen.substr(0, 10));
    const auto code = cell(data, "worst", k) - 1;
    const double worst =
        static_cast<double>(code % 900 + 100) * std::pow(10.0, static_cast<double>(code / 900) - 402);
    EXPECT_NEAR(worst / row.worst.ulps, 1, 0.005);
  }
}

TEST(Pages, TheWorstNominalOnesGetPages) {
  std::vector<FindingRow> rows = {sample_row(1, "t"), sample_row(2, "t"), sample_row(3, "t"), sample_row(4, "t")};
  rows[0].worst.ulps = 1e9;
  rows[0].conditioning = Conditioning::sliver;
  rows[1].worst.ulps = 5;
  rows[2].worst.ulps = 6;
  rows[3].worst.ulps = 5;
  const Written all = pages_of(rows, {}, {.pages = 3, .tracers = {}});
  EXPECT_THAT(all.order, ElementsAre("finding-3.case", "finding-3.html", "finding-2.case", "finding-2.html",
                                     "finding-4.case", "finding-4.html", "index.html"));
  const auto data = data_of(all["index.html"]);
  EXPECT_EQ(data["pages"], 3);
  EXPECT_EQ(cell(data, "id", 0), 3u);
  EXPECT_EQ(cell(data, "id", 3), 1u);  // in the list all the same, and last
  EXPECT_THAT(all["index.html"], HasSubstr("The worst 3 have pages of their own"));
  EXPECT_THAT(all["finding-2.html"], HasSubstr("<a href=\"finding-3.html\">← worse: 3</a>"));
  EXPECT_THAT(all["finding-2.html"], HasSubstr("<a href=\"finding-4.html\">less bad: 4 →</a>"));
  EXPECT_THAT(all["finding-4.html"], Not(HasSubstr("less bad")));
  EXPECT_THAT(pages_of(rows)["index.html"], Not(HasSubstr("have pages of their own")));
}

TEST(Pages, ACleanResultSaysWhatWasSearched) {
  const SearchRow search{.tracer = "t",
                         .source = "fuzz: space ray",
                         .ended = "2026-01-02T03:04:05Z",
                         .executions = 1234567,
                         .least_margin_ulps = 0.25};
  const std::string list = pages_of({}, {search, search})["index.html"];
  EXPECT_THAT(list, HasSubstr("Searched: 2 searches, 2 469 134 executions, of 1 tracer."));
  EXPECT_THAT(list, HasSubstr("<strong>No wrong answer was found.</strong>"));
  EXPECT_THAT(list, HasSubstr("The nearest that a case came to another answer is 0.25 ulps."));
  EXPECT_THAT(list, HasSubstr("none wrong"));
  EXPECT_THAT(pages_of({})["index.html"], HasSubstr("No search is recorded"));
}

TEST(Pages, HostileNamesStayText) {
  std::vector<FindingRow> rows;
  for (const std::string& name : hostile_names()) {
    FindingRow row = sample_row(static_cast<std::int64_t>(rows.size()) + 1, name);
    row.signature += name;
    row.builds = {name};
    row.first_seen = row.last_seen = name;
    row.worst.what.id = row.simplest.what.id = name;
    row.worst.what.provenance = {name};
    rows.push_back(row);
  }
  const SearchRow search{.tracer = hostile_names()[0], .source = hostile_names()[1], .ended = hostile_names()[2]};
  PageOptions options;
  options.repro = [](const Case&, ReproForm, std::string_view tracer) { return std::string(tracer); };
  const Written all = pages_of(rows, {search}, options);
  EXPECT_EQ(all.files.size(), 2 * rows.size() + 1);
  for (const auto& [name, text] : all.files) {
    if (name.ends_with(".case")) {
      EXPECT_EQ(parse_cases(text, name).size(), 2u) << name;
      continue;
    }
    // Nothing opens or ends a script but the page's own: one for the program, in the list one for the data.
    const auto count = [&page = text](std::string_view what) {
      std::size_t n = 0;
      for (auto at = page.find(what); at != std::string::npos; at = page.find(what, at + 1)) ++n;
      return n;
    };
    const std::size_t own = name == "index.html" ? 2 : 1;
    EXPECT_EQ(count("<script"), own) << name;
    EXPECT_EQ(count("</script"), own) << name;
    EXPECT_EQ(count("<!--"), 0u) << name;
    EXPECT_EQ(text.find('\x01'), std::string::npos) << name;
  }
  const auto data = data_of(all["index.html"]);
  for (std::size_t k = 0; k < rows.size(); ++k)
    EXPECT_EQ(data["tracers"][cell(data, "tracer", k)], rows[cell(data, "id", k) - 1].tracer);
}

TEST(FindingPage, TellsDistanceProofAndOthers) {
  const std::string page = page_of(sample_row(12, ""), hit_at(1, 0.375, 0));
  EXPECT_THAT(page, HasSubstr("<h1><code>fixed</code> calls this a hit; the ray passes outside edge AB</h1>"));
  EXPECT_THAT(
      page,
      HasSubstr("move by <strong>4 ulps</strong>: as much as the rounding of a few coordinates; the triangle's "));
  EXPECT_THAT(page, HasSubstr("It passes 4 ulps outside the triangle. The grid is one ulp wide."));
  EXPECT_THAT(page, HasSubstr("It passes 2 ulps outside the triangle."));
  EXPECT_THAT(page,
              HasSubstr("<th scope=\"row\">w<sub>AB</sub><td class=\"sign\">+<td>against the sign of det: outer side"
                        "<td class=\"exact\">1 * 2^-50</tr>"));
  EXPECT_THAT(
      page,
      HasSubstr("<th scope=\"row\">det<td class=\"sign\">−<td>it comes from the front<td class=\"exact\">-1</tr>"));
  EXPECT_THAT(page, HasSubstr("Wrong are 1 of 2 on the simplest case, 1 of 2 on the worst case."));
  EXPECT_THAT(page, HasSubstr("miss, right"));
  EXPECT_THAT(page, HasSubstr("hit, wrong by 4 ulps"));
  EXPECT_THAT(page,
              HasSubstr("Of the 30 cases beside it, one ulp away in one number, <strong>30</strong> are wrong too"));
  EXPECT_THAT(page,
              HasSubstr("<th scope=\"row\">origin y<td class=\"n\">-8.881784197001252e-16<td class=\"n\">-0x1p-50"));
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\">origin y<td class=\"n\">-1/2^50"));
  EXPECT_THAT(page, HasSubstr("plumbline replay finding-12.case --tracer fixed"));
}

TEST(FindingPage, CountsNeighboursThatAreWrong) {
  FindingRow row = sample_row(1, "");
  row.kind = FindingKind::false_miss;
  row.signature = "false-miss-ca-nominal-c0";
  row.worst.what = row.simplest.what = case_at("deep", 0.25, 0.25);
  EXPECT_THAT(page_of(row, a_miss), HasSubstr("<strong>30</strong> are wrong too: it lies amid a region"));
  // The least step up of the origin, or of the direction, puts the ray onto the edge, and a hit is right.
  row = sample_row(1, "");
  row.worst.what = row.simplest.what = case_at("least", 0.375, -0x1p-1074);
  EXPECT_THAT(page_of(row, a_hit), HasSubstr("<strong>28</strong> are wrong too"));
}

TEST(FindingPage, ShowsTheEndOfARangeFromTheSide) {
  FindingRow row = sample_row(1, "");
  row.element = Element::t_min;
  row.worst.what = case_at("late", 0.25, 0.25);
  row.worst.what.ray.t_min = 0x1.0000000000002p+0;
  row.simplest = row.worst;
  const std::string page = page_of(row, hit_at(1));
  EXPECT_THAT(page, HasSubstr("calls this a hit; the triangle lies before the start of the ray&#39;s range"));
  EXPECT_THAT(page, HasSubstr("The range&#39;s start is 2 ulps behind the plane."));
}

TEST(FindingPage, ShowsWhereADisplacedPointIs) {
  FindingRow row = sample_row(1, "");
  row.kind = FindingKind::displaced;
  row.element = Element::none;
  row.worst.what = row.simplest.what = case_at("inside", 0.25, 0.25);
  const std::string page = page_of(row, hit_at(1, 0.5, 0.25));
  EXPECT_THAT(page, HasSubstr("those of a point 1.13e15 ulps beside it"));  // 2^-2 of 2^-52
  EXPECT_THAT(page, HasSubstr("the tracer's point"));
  row.element = Element::plane;
  EXPECT_THAT(page_of(row, hit_at(1.5, 0.25, 0.25)), HasSubstr("point is 2.25e15 ulps off the plane"));
}

TEST(FindingPage, SaysWhatItCannotKnow) {
  FindingRow row = sample_row(1, "gone");
  const std::string page = pages_of({row})["finding-1.html"];
  EXPECT_THAT(page, HasSubstr("not in this build"));
  EXPECT_THAT(page, Not(HasSubstr("cases beside it")));
  EXPECT_THAT(page, HasSubstr("1 * 2^-50"));  // the proof needs no tracer
  EXPECT_THAT(page_of(row, a_miss), HasSubstr("This build gets it right."));
}

TEST(FindingPage, LinksWhatItIsADuplicateOf) {
  FindingRow row = sample_row(1, "t");
  row.status = FindingStatus::duplicate;
  row.duplicate_of = 2;
  EXPECT_THAT(pages_of({row, sample_row(2, "t")})["finding-1.html"],
              HasSubstr("duplicate of <a href=\"finding-2.html\">2</a>"));
  EXPECT_THAT(pages_of({row})["finding-1.html"], HasSubstr("<dd>duplicate of 2</dd>"));
}

TEST(FindingPage, HasTheReprosThatThereAre) {
  PageOptions options;
  options.repro = [](const Case& what, ReproForm form, std::string_view tracer) -> std::optional<std::string> {
    if (form != ReproForm::python_proof) return std::nullopt;
    return what.id + " of " + std::string(tracer) + " <proof>";
  };
  const std::string page = pages_of({sample_row(1, "t")}, {}, options)["finding-1.html"];
  EXPECT_THAT(page, HasSubstr("<pre id=\"repro-python-proof\" tabindex=\"0\">simplest of t &lt;proof&gt;</pre>"));
  EXPECT_THAT(page, Not(HasSubstr("repro-obj")));
}

TEST(FindingPage, ItsCasesReadBack) {
  const auto cases = parse_cases(pages_of({sample_row(5, "t")})["finding-5.case"], "finding-5.case");
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].id, "finding-5-simplest");
  EXPECT_EQ(cases[0].ray, case_at("", 0.5, -0x1p-51).ray);
  EXPECT_EQ(cases[1].id, "finding-5-worst");
  EXPECT_THAT(cases[1].known, ElementsAre(Known{"t", VerdictKind::false_hit}));
}

// A pair that the tracer misses, and a triangle behind it that it hits.
FindingRow row_of_several(const std::string& tracer) {
  FindingRow row = sample_row(9, tracer);
  row.signature = "wrong-nearest-interior";
  row.kind = FindingKind::wrong_nearest;
  row.element = Element::none;
  row.worst.what = row.simplest.what = case_of(leaking_pair + behind_the_pair);
  row.worst.ulps = row.simplest.ulps = 7;
  return row;
}

TEST(FindingPage, TellsAllThatTheRayMeetsOfSeveralTriangles) {
  const Tracer& tracer = find_tracer("moller_trumbore_f64");
  const PageOptions options{.tracers = {&tracer, &find_tracer("exact")}};
  const Written all = pages_of({row_of_several("moller_trumbore_f64")}, {}, options);
  const std::string page = all["finding-9.html"];
  EXPECT_THAT(page, HasSubstr("hits another triangle than the ray has to hit first</h1>"));
  EXPECT_THAT(page, HasSubstr("3 triangles, "));
  EXPECT_THAT(page, HasSubstr("<td>hit of triangle 2<td>first triangle"));
  EXPECT_THAT(page, HasSubstr("The verdict: <strong>wrong-nearest</strong>."));
  EXPECT_THAT(page, HasSubstr("aria-label=\"The triangles, seen along the ray\""));
  EXPECT_THAT(page, HasSubstr("<td class=\"n\">3<td class=\"n\">"));  // the third place, that of the triangle behind
  EXPECT_THAT(page, HasSubstr("Wrong are 1 of 2 on the only case kept."));
  EXPECT_THAT(page, HasSubstr("plumbline explain finding-9.case --id finding-9-worst --tracer moller_trumbore_f64"));
  EXPECT_THAT(page, Not(HasSubstr("plumbline shrink")));
  const auto cases = parse_cases(all["finding-9.case"], "finding-9.case");
  EXPECT_THAT(cases[0].known, ElementsAre(Known{"moller_trumbore_f64", VerdictKind::wrong_nearest}));
  EXPECT_EQ(data_of(all["index.html"])["classes"][0].get<std::vector<int>>()[0],
            static_cast<int>(FindingKind::wrong_nearest));
}

TEST(FindingPage, SaysOfSeveralTrianglesWhatItCannotKnow) {
  const std::string page = pages_of({row_of_several("gone")})["finding-9.html"];
  EXPECT_THAT(page, HasSubstr("<td>not in this build<td>first triangle"));
  EXPECT_THAT(page, Not(HasSubstr("The verdict")));
  EXPECT_THAT(pages_of({row_of_several("exact")}, {}, {.tracers = {&find_tracer("exact")}})["finding-9.html"],
              HasSubstr("This build gets it right."));
}

TEST(FindingPage, HostileNamesOfSeveralTrianglesStayText) {
  for (const std::string& name : hostile_names()) {
    FindingRow row = row_of_several(name);
    row.worst.what.id = row.simplest.what.id = name;
    row.worst.what.provenance = {name};
    const std::string page = pages_of({row})["finding-9.html"];
    EXPECT_EQ(page.find("<script", page.find("<script") + 1), std::string::npos) << name;
    EXPECT_EQ(page.find("<!--"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace plumbline
