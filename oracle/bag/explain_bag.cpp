#include "oracle/bag/explain_bag.h"

#include <algorithm>
#include <array>

#include "oracle/explain.h"
#include "oracle/explain_lines.h"

namespace plumbline {
namespace {

constexpr std::array<std::string_view, bag_verdict_names.size()> meanings = {
    "what has to be hit first is",
    "a point has to be hit, and nothing is",
    "there is nothing that may be hit, or not there",
    "another triangle has to be hit first",
    "more is hit than is there",
    "hits in the wrong order",
    "inside and outside taken for each other",
    "the wrong pieces are taken for inside",
    "the contract leaves it open",
    "no answer"};

void add_hits(Lines& lines, std::span<const Triangle> triangles, const Query& query, const BagTruth& truth) {
  const BagHit* before = nullptr;
  for (const BagHit& hit : truth.hits) {
    if (!before || before->rank != hit.rank) {
      const ExactRatio t = *certificate(triangles[hit.triangle], query).t;
      lines.add(fmt::format("hit {}", hit.rank + 1), "t = {}", t.exact);
      lines.add("", "binary64 {}   binary32 {:a}", number(t.binary64), t.binary32);
    }
    lines.add("", "triangle {}: {}, from the {}{}", hit.triangle, met_at(hit.truth),
              hit.truth.det_sign < 0 ? "front" : "back",
              hit.owner && hit.truth.hit_class != HitClass::interior ? ", its owner" : "");
    before = &hit;
  }
}

// Those that are crossed where a hit had to be, in explain_bag's order.
std::span<const BagHit> due(const BagTruth& truth, const BagJudgement& judgement) {
  if (judgement.due == HitClass::exterior) return {};
  const auto [begin, end] = std::ranges::equal_range(truth.hits, judgement.due_rank, {}, &BagHit::rank);
  return {begin, end};
}

void add_due(Lines& lines, const BagTruth& truth, const BagJudgement& judgement) {
  const std::span<const BagHit> hits = due(truth, judgement);
  if (hits.empty()) {
    lines.add("asks", "no triangle that is crossed must be hit");
    return;
  }
  std::string text;
  for (const BagHit& hit : hits)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", hit.triangle, met_at(hit.truth));
  lines.add("asks", "must hit {} {}, t = {}", hits.size() == 1 ? "triangle" : "one of the triangles", text,
            hits.front().t);
}

bool names_triangle(const Answer& answer) { return answer.outcome == Outcome::hit && answer.has_t; }

void add_reported(Lines& lines, const BagQuestion& question, std::uint32_t triangle) {
  const BagTruth& truth = question.truth;
  std::string met = "which the ray misses";
  if (const auto hit = std::ranges::find(truth.hits, triangle, &BagHit::triangle); hit != truth.hits.end())
    met = fmt::format("which is hit {}", hit->rank + 1);
  if (std::ranges::count(truth.stretches, triangle, &Stretch::triangle) != 0) met = "which is touched";
  if (triangle >= question.triangles.size()) met = "which isn't there";
  lines.add("", "triangle {}, {}", triangle, met);
}

}  // namespace

std::string met_at(const Truth& truth) {
  std::string text(name(truth.hit_class));
  if (truth.feature != Feature::none) text += fmt::format(" {}", name(truth.feature));
  return text;
}

std::string explain_bag(std::span<const Triangle> triangles, const Query& query, const BagTruth& truth) {
  Lines lines;
  add_query(lines, query);
  if (truth.invalid != Invalid::none) {
    lines.add("class", "invalid: {}", reason(truth.invalid));
    return lines.take();
  }
  lines.add("crossed", "{} of {} triangles, which are counted from 0; in the exact order of t", truth.hits.size(),
            triangles.size());
  add_hits(lines, triangles, query, truth);
  for (const Stretch& s : truth.stretches)
    lines.add("touched", "triangle {}: {}, t from {} to {}: a matter of convention", s.triangle, name(s.hit_class),
              s.low, s.high);
  return lines.take();
}

std::string explain_bag_verdict(const BagQuestion& question, const Answer& answer, const BagJudgement& judgement) {
  Lines lines;
  lines.add("verdict", "{}: {}", name(judgement.verdict), meanings[static_cast<unsigned>(judgement.verdict)]);
  const bool wrong = judgement.verdict != BagVerdict::correct && judgement.verdict != BagVerdict::unspecified &&
                     judgement.verdict != BagVerdict::fault;
  if (wrong) add_severity(lines, judgement.length, judgement.ulps);
  if (judgement.verdict != BagVerdict::fault) add_due(lines, question.truth, judgement);
  add_answer(lines, answer);
  if (names_triangle(answer)) add_reported(lines, question, answer.triangle);
  add_contract(lines, question.contract);
  return lines.take();
}

std::vector<std::uint32_t> concerned(const BagQuestion& question, const Answer& answer, const BagJudgement& judgement) {
  std::vector<std::uint32_t> list;
  const auto add = [&](std::uint32_t triangle) {
    if (std::ranges::find(list, triangle) == list.end()) list.push_back(triangle);
  };
  for (const BagHit& hit : due(question.truth, judgement)) add(hit.triangle);
  if (names_triangle(answer) && answer.triangle < question.triangles.size()) add(answer.triangle);
  for (const BagHit& hit : question.truth.hits) add(hit.triangle);
  for (const Stretch& s : question.truth.stretches) add(s.triangle);
  return list;
}

}  // namespace plumbline
