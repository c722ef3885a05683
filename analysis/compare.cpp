#include "analysis/compare.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/finite.h"
#include "case/input_error.h"
#include "case/precision.h"
#include "oracle/classify.h"
#include "oracle/contact.h"

namespace plumbline {
namespace {

constexpr std::size_t class_count = hit_class_names.size();

void check(const ComparePlan& plan) {
  if (plan.tracers.empty()) throw InputError("no tracer to compare; name one or more, or 'all'");
  if (plan.families.empty()) throw InputError("no family to compare on; name one or more");
  if (plan.count == 0) throw InputError("no case to compare on; give a count of 1 or more");
  for (std::size_t i = 0; i < plan.tracers.size(); ++i)
    if (std::ranges::count(plan.tracers, plan.tracers[i]) > 1)
      throw InputError(fmt::format("tracer '{}' is named twice", plan.tracers[i]->info().name));
  if (plan.inputs == Precision::binary32) return;
  for (const Tracer* tracer : plan.tracers)
    if (tracer->info().contract.precision == Precision::binary32)
      throw InputError(fmt::format("tracer '{}' reads binary32: it would be asked other rays than the rest; leave it out or "
                                   "take binary32 inputs",
                                   tracer->info().name));
}

bool is_finite(const Case& c) {
  return plumbline::is_finite(c.bag.triangles.front()) && plumbline::is_finite(c.ray.origin) &&
         plumbline::is_finite(c.ray.direction);
}

// No value where the case is invalid once it is rounded.
std::optional<Case> draw_case(const ComparePlan& plan, Family family, std::uint64_t index) {
  const Shot shot = draw(family, plan.seed, index);
  Case drawn;
  drawn.id = fmt::format("{}-{}-{}", name(family), plan.seed, index);
  drawn.bag.triangles = {shot.triangle};
  drawn.ray = shot.ray;
  drawn = put_at(std::move(drawn), plan.inputs);
  drawn.precision = plan.inputs;
  if (!is_finite(drawn) || drawn.ray.direction == Vec3{}) return std::nullopt;
  return drawn;
}

class Comparison {
 public:
  explicit Comparison(const ComparePlan& plan) : replies_(plan.tracers.size()) {
    const std::size_t tracers = plan.tracers.size(), families = plan.families.size();
    result_.plan = plan;
    result_.scores.assign(tracers, std::vector<Score>(families));
    result_.worst.assign(tracers, std::vector<std::vector<WrongCase>>(families));
    result_.conduct.resize(tracers);
    result_.duels.assign(tracers * (tracers - 1) / 2,
                         std::vector<std::vector<Duel>>(families, std::vector<Duel>(class_count)));
  }

  void run(std::size_t family, std::uint64_t index) {
    ++result_.done;
    const auto asked = draw_case(result_.plan, result_.plan.families[family], index);
    if (!asked) return;
    const Triangle& triangle = asked->bag.triangles.front();
    const Truth truth = classify(triangle, asked->ray);
    for (std::size_t i = 0; i < replies_.size(); ++i) {
      replies_[i] = ask(*result_.plan.tracers[i], *asked);
      result_.conduct[i] += replies_[i].conduct;
      score(i, family, *asked, truth);
    }
    match(family, truth, hit(triangle, asked->ray, truth));
  }

  CompareResult take() { return std::move(result_); }

 private:
  void score(std::size_t tracer, std::size_t family, const Case& asked, const Truth& truth) {
    const Contract& contract = result_.plan.tracers[tracer]->info().contract;
    const Reply& reply = replies_[tracer];
    Score& score = result_.scores[tracer][family];
    ++score.cases;
    if ((truth.hit_class == HitClass::edge || truth.hit_class == HitClass::vertex) && crosses(truth) &&
        reply.answer.outcome != Outcome::fault) {
      ++score.boundary;
      score.boundary_hits += reply.answer.outcome == Outcome::hit;
    }
    const Judgement judgement = judge(asked, reply, contract);
    const VerdictKind as_ray =
        reply.query == Query(asked.ray) ? judgement.verdict : judge(asked, reply.answer, contract).verdict;
    score.ray_false_misses += as_ray == VerdictKind::false_miss;
    score.ray_false_hits += as_ray == VerdictKind::false_hit;
    score.false_misses += judgement.verdict == VerdictKind::false_miss;
    score.false_hits += judgement.verdict == VerdictKind::false_hit;
    score.unspecified += judgement.verdict == VerdictKind::unspecified;
    score.faults += judgement.verdict == VerdictKind::fault;
    if (!wrong(judgement.verdict)) return;
    const bool nominal = judgement.severity && judgement.severity->condition.nominal();
    const double ulps = judgement.severity ? judgement.severity->ulps : 0;
    if (nominal) score.worst_nominal_ulps = std::max(score.worst_nominal_ulps, ulps);
    keep(result_.worst[tracer][family], tracer, judgement, {.asked = asked, .ulps = ulps, .nominal = nominal});
  }

  void keep(std::vector<WrongCase>& list, std::size_t tracer, const Judgement& judgement, WrongCase found) {
    const auto worse = [](const WrongCase& x, const WrongCase& y) {
      return x.nominal != y.nominal ? x.nominal : x.ulps > y.ulps;
    };
    if (list.size() == result_.plan.worst && (list.empty() || !worse(found, list.back()))) return;
    const TracerInfo& info = result_.plan.tracers[tracer]->info();
    found.asked.id += "-" + info.name;
    found.asked.provenance = {fmt::format("{}: {} by {:.3g} ulps{}", info.name, name(judgement.verdict), found.ulps,
                                          found.nominal ? "" : ", ill-conditioned")};
    found.asked.known = {{info.name, judgement.verdict}};
    list.insert(std::ranges::upper_bound(list, found, worse), std::move(found));
    if (list.size() > result_.plan.worst) list.pop_back();
  }

  void match(std::size_t family, const Truth& truth, std::optional<bool> hit) {
    const auto at = static_cast<std::size_t>(truth.hit_class);
    for (std::size_t i = 0; i < replies_.size(); ++i)
      for (std::size_t j = i + 1; j < replies_.size(); ++j) {
        const Outcome first = replies_[i].answer.outcome, second = replies_[j].answer.outcome;
        if (first == second || first == Outcome::fault || second == Outcome::fault) continue;
        Duel& duel = result_.duels[pair_index(i, j, replies_.size())][family][at];
        ++duel.differ;
        if (!hit) continue;
        const bool first_hit = first == Outcome::hit;
        ++(first_hit == *hit ? duel.first_right : duel.second_right);
      }
  }

  CompareResult result_;
  std::vector<Reply> replies_;
};

}  // namespace

std::size_t pair_index(std::size_t first, std::size_t second, std::size_t tracers) {
  return first * tracers - first * (first + 1) / 2 + second - first - 1;
}

bool suits_binary32(Family family) {
  switch (family) {
    case Family::exact_edge51:
    case Family::ulp12:
    case Family::ulp51:
    case Family::wide:
    case Family::wide_edge:
    case Family::full_range: return false;
    default: return true;
  }
}

CompareResult compare(const ComparePlan& plan, const std::atomic<bool>& stop, const CompareProgress& progress) {
  check(plan);
  Comparison comparison(plan);
  const std::uint64_t planned = plan.count * plan.families.size();
  std::uint64_t done = 0;
  for (std::uint64_t index = 0; index < plan.count && !stop; ++index)
    for (std::size_t family = 0; family < plan.families.size() && !stop; ++family) {
      comparison.run(family, index);
      if (progress) progress(++done, planned);
    }
  return comparison.take();
}

}  // namespace plumbline
