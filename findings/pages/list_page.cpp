#include "findings/pages/list_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "case/json_object.h"
#include "findings/pages/html.h"
#include "findings/pages/templates.h"
#include "findings/pages/words.h"

namespace plumbline {
namespace {

// A column of whole numbers for list.js: {"width":2,"digits":"0a1f"}, each in as many digits to base 36 as the
// largest takes. A hundred thousand rows are 2 MB that way, and read in no time.
std::string column(const std::vector<std::uint64_t>& numbers) {
  constexpr std::string_view digits = "0123456789abcdefghijklmnopqrstuvwxyz";
  std::uint64_t largest = 0;
  for (const std::uint64_t n : numbers) largest = std::max(largest, n);
  std::size_t width = 0;
  for (; largest > 0; largest /= 36) ++width;
  std::string text(numbers.size() * width, '0');
  for (std::size_t row = 0; row < numbers.size(); ++row) {
    std::uint64_t n = numbers[row];
    for (std::size_t k = width; k-- > 0; n /= 36) text[row * width + k] = digits[n % 36];
  }
  return fmt::format(R"({{"width":{},"digits":"{}"}})", width, text);
}

// A severity to three digits as a whole number that grows with it: 0 for 0, else 1 + 900 (400 + e) + (m - 100) for
// m * 10^(e - 2), 100 <= m < 1000.
std::uint64_t three_digits(double x) {
  if (!(x > 0)) return 0;
  if (!std::isfinite(x)) return 1 + 900 * 800;
  const std::string text = fmt::format("{:.2e}", x);  // 1.65e+14
  const int m = (text[0] - '0') * 100 + (text[2] - '0') * 10 + (text[3] - '0');
  return static_cast<std::uint64_t>(1 + 900 * (400 + std::stoi(text.substr(5))) + (m - 100));
}

// Each text once, and which of them a row has.
class Dictionary {
 public:
  std::uint64_t index(const std::string& word) {
    const auto [it, added] = indices_.emplace(word, words_.size());
    if (added) words_.push_back(word);
    return it->second;
  }
  const std::vector<std::string>& words() const { return words_; }

 private:
  std::map<std::string, std::uint64_t> indices_;
  std::vector<std::string> words_;
};

template <class Words>
std::string json_list(const Words& words) {
  std::string out = "[";
  for (const auto& word : words) {
    if (out.size() > 1) out += ',';
    append_json_string(out, word);
  }
  return out + "]";
}

std::string data_of(std::span<const FindingRow* const> ranks, std::size_t paged) {
  Dictionary tracers, signatures, days;
  std::vector<std::string> classes;  // of each signature: its kind, element and conditioning
  const auto day = [&](const std::string& when) { return days.index(when.substr(0, 10)); };
  std::vector<std::uint64_t> id, tracer, signature, worst, bits, count, status, fresh, first, last;
  for (const FindingRow* const r : ranks) {
    id.push_back(static_cast<std::uint64_t>(r->id));
    tracer.push_back(tracers.index(r->tracer));
    signature.push_back(signatures.index(r->signature));
    if (signatures.words().size() > classes.size())
      classes.push_back(fmt::format("[{},{},{}]", static_cast<int>(r->kind), static_cast<int>(r->element),
                                    static_cast<int>(r->conditioning)));
    worst.push_back(three_digits(r->worst.ulps));
    bits.push_back(r->simplest.bits);
    count.push_back(r->count);
    status.push_back(static_cast<std::uint64_t>(r->status));
    fresh.push_back(r->is_new);
    first.push_back(day(r->first_seen));
    last.push_back(day(r->last_seen));
  }
  std::string list;
  for (const std::string& c : classes) list += (list.empty() ? "" : ",") + c;
  std::string json;
  JsonObject data(json);
  data.number("rows", static_cast<double>(ranks.size()));
  data.number("pages", static_cast<double>(paged));
  data.member("tracers") += json_list(tracers.words());
  data.member("signatures") += json_list(signatures.words());
  data.member("classes") += "[" + list + "]";
  data.member("kinds") += json_list(finding_kind_names);
  data.member("elements") += json_list(element_names);
  data.member("conditionings") += json_list(conditioning_names);
  data.member("statuses") += json_list(finding_status_names);
  data.member("days") += json_list(days.words());
  std::string& columns = data.member("columns");
  JsonObject all(columns);
  all.member("id") += column(id);
  all.member("tracer") += column(tracer);
  all.member("signature") += column(signature);
  all.member("worst") += column(worst);
  all.member("bits") += column(bits);
  all.member("count") += column(count);
  all.member("status") += column(status);
  all.member("fresh") += column(fresh);
  all.member("first") += column(first);
  all.member("last") += column(last);
  all.end_line();
  data.end_line();
  return json_in_html(std::move(json));
}

std::string thousands(std::uint64_t n) {
  std::string text = std::to_string(n);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, " ");
  return text;
}

std::string counted(std::uint64_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", thousands(n), n == 1 ? one : many);
}

std::string worst_words(double ulps) { return ulps > 0 ? in_ulps(ulps) : "none wrong"; }

// What was searched, and what came of it.
std::string summary_of(std::span<const FindingRow* const> ranks, std::size_t paged,
                       std::span<const SearchRow> searches) {
  std::uint64_t executions = 0;
  double worst = 0, margin = 0;
  std::set<std::string_view> searched, wrong;
  for (const SearchRow& s : searches) {
    executions += s.executions;
    searched.insert(s.tracer);
    worst = std::max(worst, s.worst_nominal_ulps);
    if (s.least_margin_ulps > 0) margin = margin > 0 ? std::min(margin, s.least_margin_ulps) : s.least_margin_ulps;
  }
  std::size_t fresh = 0;
  for (const FindingRow* const r : ranks) {
    wrong.insert(r->tracer);
    fresh += r->is_new;
  }
  std::string text;
  if (!searches.empty())
    text +=
        fmt::format("<p>Searched: {}, {}, of {}.", counted(searches.size(), "search", "searches"),
                    counted(executions, "execution", "executions"), counted(searched.size(), "tracer", "tracers"));
  else
    text += "<p>No search is recorded with these findings.";
  if (ranks.empty())
    text += searches.empty() ? " And there are none." : " <strong>No wrong answer was found.</strong>";
  else
    text += fmt::format(" Found: {}, in {}{}.", counted(ranks.size(), "way to be wrong", "ways to be wrong"),
                        counted(wrong.size(), "tracer", "tracers"),
                        fresh > 0 ? fmt::format("; {} new", thousands(fresh)) : "");
  if (worst > 0) text += fmt::format(" The worst nominal severity reached is <strong>{}</strong>.", in_ulps(worst));
  if (margin > 0) text += fmt::format(" The nearest that a case came to another answer is {}.", in_ulps(margin));
  text += "</p>";
  if (paged < ranks.size())
    text += fmt::format(
        "<p>The worst {} have pages of their own, linked by their numbers; the others are listed only.</p>",
        thousands(paged));
  return text;
}

std::string searches_of(std::span<const SearchRow> searches) {
  if (searches.empty()) return "";
  std::vector<const SearchRow*> newest;
  for (const SearchRow& s : searches) newest.push_back(&s);
  std::ranges::sort(newest, [](const SearchRow* x, const SearchRow* y) {
    return x->ended != y->ended ? x->ended > y->ended : x < y;
  });
  constexpr std::size_t most = 200;
  std::string text = fmt::format(
      "<details{}><summary>What was searched</summary><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"Searches\"><table><thead><tr><th>Tracer<th>Search<th>Ended<th class=\"n\">Executions<th "
      "class=\"n\">Worst "
      "nominal severity<th class=\"n\">Nearest to another answer<th class=\"n\">Signatures</tr></thead><tbody>",
      newest.size() <= 8 ? " open" : "");
  for (const SearchRow* const s : std::span(newest).first(std::min(most, newest.size())))
    text += fmt::format(
        "<tr><td>{}<td class=\"words\">{}<td class=\"one-line\">{}<td class=\"n\">{}<td class=\"n\">{}<td "
        "class=\"n\">{}<td class=\"n\">{}</tr>",
        escaped(s->tracer), escaped(s->source), escaped(s->ended), thousands(s->executions),
        worst_words(s->worst_nominal_ulps), s->least_margin_ulps > 0 ? in_ulps(s->least_margin_ulps) : "",
        thousands(s->signatures));
  text += "</tbody></table></div>";
  if (newest.size() > most) text += fmt::format("<p>And {} before these.</p>", thousands(newest.size() - most));
  return text + "</details>";
}

}  // namespace

std::string list_page(std::span<const FindingRow* const> ranks, std::size_t paged,
                      std::span<const SearchRow> searches) {
  return filled(list_html, {{"style", page_css},
                            {"script", list_js},
                            {"summary", summary_of(ranks, paged, searches)},
                            {"searches", searches_of(searches)},
                            {"data", data_of(ranks, paged)}});
}

}  // namespace plumbline
