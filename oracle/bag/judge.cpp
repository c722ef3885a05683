#include "oracle/bag/judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "case/float_bits.h"
#include "oracle/classify.h"
#include "oracle/default_controls.h"
#include "oracle/exact_case.h"
#include "oracle/judge.h"
#include "oracle/largest.h"
#include "oracle/round.h"
#include "oracle/severity.h"

namespace plumbline {
namespace {

using exact::Dyadic;
using exact::ExactCase;
using exact::Quotient;

constexpr double infinity = std::numeric_limits<double>::infinity();

// The triangles crossed at one t.
using Group = std::span<const BagHit>;

std::vector<Group> groups(const BagTruth& truth) {
  std::vector<Group> list;
  for (std::size_t begin = 0, end = 0; begin < truth.hits.size(); begin = end) {
    while (end < truth.hits.size() && truth.hits[end].rank == truth.hits[begin].rank) ++end;
    list.push_back(Group(truth.hits).subspan(begin, end - begin));
  }
  return list;
}

struct Edge {
  Vec3 from, to;
  bool same(const Edge& e) const { return (from == e.from && to == e.to) || (from == e.to && to == e.from); }
};

// Those of a triangle that hold the point where it is crossed.
void add_edges_met(const Triangle& t, Feature at, std::vector<Edge>& edges) {
  if (at == Feature::ab || at == Feature::a || at == Feature::b) edges.push_back({t.a, t.b});
  if (at == Feature::bc || at == Feature::b || at == Feature::c) edges.push_back({t.b, t.c});
  if (at == Feature::ca || at == Feature::c || at == Feature::a) edges.push_back({t.c, t.a});
}

class Judge {
 public:
  explicit Judge(const BagQuestion& q) : q_(q), groups_(groups(q.truth)) {
    for (const Group& group : groups_) must_.push_back(must(group));
  }

  BagJudgement nearest(const Answer& answer) const {
    BagJudgement judged = answer.outcome != Outcome::hit ? nothing_hit()
                          : answer.has_t                 ? nearest_hit(answer.triangle)
                                                         : some_hit();
    if (const Group* due = first_due()) {
      for (const BagHit& hit : *due) judged.due = std::min(judged.due, hit.truth.hit_class);
      judged.due_rank = due->front().rank;
    }
    return judged;
  }

  BagJudgement hits(std::span<const Answer> hits) const {
    const bool any_must = any_due();
    BagJudgement worst_false, lost;
    std::size_t false_hits = 0;
    for (const Answer& hit : hits) {
      if (claim(hit.triangle) != VerdictKind::false_hit) continue;
      ++false_hits;
      take_worse(worst_false, one_wrong(hit.triangle, true));
    }
    bool leaks = false, shares = false;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (!must_[i]) continue;
      const auto count = std::ranges::count_if(groups_[i], [&](const BagHit& met) {
        return std::ranges::count(hits, met.triangle, &Answer::triangle) != 0;
      });
      shares = shares || (count > 1 && has_one_owner(groups_[i]));
      if (count != 0) continue;
      leaks = true;
      take_worse(lost, missed(groups_[i]));
    }
    for (const Stretch& touched : q_.truth.stretches) {
      if (!must(touched) || std::ranges::count(hits, touched.triangle, &Answer::triangle) != 0) continue;
      leaks = true;
      take_worse(lost, {BagVerdict::leak});
    }
    if (false_hits > 0) {
      worst_false.verdict = leaks                      ? BagVerdict::wrong_nearest
                            : hits.size() > false_hits ? BagVerdict::double_hit
                                                       : BagVerdict::false_hit;
      return worst_false;
    }
    if (leaks) return lost;
    const auto twice = [&](const Answer& hit) { return std::ranges::count(hits, hit.triangle, &Answer::triangle) > 1; };
    if (shares || std::ranges::any_of(hits, twice)) return {BagVerdict::double_hit};
    return {any_must ? BagVerdict::correct : quiet()};
  }

  BagJudgement order(std::span<const Answer> hits) const {
    BagJudgement worst;
    for (const Answer& x : hits)
      for (const Answer& y : hits) {
        const BagHit *first = met(x.triangle), *second = met(y.triangle);
        if (!first || !second || !x.has_t || !y.has_t || first->rank >= second->rank || !(x.t > y.t)) continue;
        BagJudgement here = apart(x.triangle, y.triangle);
        here.verdict = BagVerdict::wrong_order;
        take_worse(worst, here);
      }
    return worst;
  }

  BagJudgement parity(std::span<const Answer> hits) const {
    const auto crossings = q_.truth.crossings();
    const Contract& c = q_.contract;
    const bool silent = c.culling != Culling::none || !is_zero(c.slack_absolute) || !is_zero(c.slack_relative);
    if (!crossings || silent || !q_.truth.stretches.empty()) return {BagVerdict::unspecified};
    for (const Group& group : groups_)
      if (!(group.size() == 1 && within(group.front()) && group.front().truth.hit_class == HitClass::interior) &&
          !has_one_owner(group))
        return {BagVerdict::unspecified};
    if (hits.size() % 2 == *crossings % 2) return {};
    BagJudgement worst{BagVerdict::wrong_parity};
    for (const Answer& hit : hits)
      if (claim(hit.triangle) == VerdictKind::false_hit) take_worse(worst, one_wrong(hit.triangle, true));
    for (const BagHit& met : q_.truth.hits)
      if (std::ranges::count(hits, met.triangle, &Answer::triangle) == 0)
        take_worse(worst, one_wrong(met.triangle, false));
    worst.verdict = BagVerdict::wrong_parity;
    return worst;
  }

  // The length of the ray from t = x to y, which are numbers; in ulps of the largest coordinate of all triangles.
  BagJudgement piece(double x, double y) const {
    if (!is_finite(x) || !is_finite(y)) return {BagVerdict::wrong_thickness, infinity, infinity};
    double largest = largest_magnitude(q_.query.ray.origin);
    for (const Triangle& t : q_.triangles) largest = std::max(largest, largest_magnitude(t.a, t.b, t.c));
    return stretch(Quotient(Dyadic(y) - Dyadic(x)), largest, BagVerdict::wrong_thickness);
  }

 private:
  static void take_worse(BagJudgement& worst, const BagJudgement& here) {
    const bool first = worst.verdict == BagVerdict::correct;
    if (first || here.length > worst.length) worst = here;
  }

  const BagHit* met(std::uint32_t triangle) const {
    const auto it = std::ranges::find(q_.truth.hits, triangle, &BagHit::triangle);
    return it == q_.truth.hits.end() ? nullptr : &*it;
  }

  // Of a hit that is reported: false_hit, or else correct or unspecified.
  VerdictKind claim(std::uint32_t triangle) const {
    const Triangle& t = q_.triangles[triangle];
    return judge(t, q_.query, classify(t, q_.query), {.outcome = Outcome::hit}, q_.contract);
  }

  static bool within(const BagHit& hit) { return hit.truth.versus_t_min > 0 && hit.truth.versus_t_max < 0; }

  // Whether triangles share this point all around and the ray goes through them once: each edge at the point has a
  // triangle on either side, and all of them are met from one side. Then turning the ray aside a little, wherever to,
  // makes it cross as many as own the hit.
  bool has_one_owner(const Group& group) const {
    if (q_.contract.edges != EdgeRule::one_owner || q_.truth.on_surface) return false;
    std::vector<Edge> edges;
    for (const BagHit& hit : group) {
      if (!within(hit) || hit.truth.hit_class == HitClass::interior) return false;
      if (hit.truth.det_sign != group.front().truth.det_sign) return false;
      add_edges_met(q_.triangles[hit.triangle], hit.truth.feature, edges);
    }
    const auto shared = [&](const Edge& e) {
      return std::ranges::count_if(edges, [&](const Edge& other) { return e.same(other); }) == 2;
    };
    return std::ranges::all_of(edges, shared) && std::ranges::count(group, true, &BagHit::owner) == 1;
  }

  bool must(const Group& group) const {
    const auto duty_of = [&](const BagHit& hit) {
      return duty(q_.triangles[hit.triangle], q_.query, hit.truth, q_.contract);
    };
    if (std::ranges::any_of(group, [&](const BagHit& hit) { return duty_of(hit) == Duty::hit; })) return true;
    return has_one_owner(group) &&
           std::ranges::all_of(group, [&](const BagHit& hit) { return duty_of(hit) == Duty::any; });
  }

  bool must(const Stretch& touched) const {
    return duty(q_.triangles[touched.triangle], q_.query, {.hit_class = touched.hit_class}, q_.contract) == Duty::hit;
  }

  // Where nothing must be hit and no hit is wrong.
  BagVerdict quiet() const {
    const auto may = [&](std::uint32_t triangle, const Truth& truth) {
      return duty(q_.triangles[triangle], q_.query, truth, q_.contract) != Duty::miss;
    };
    const bool met = std::ranges::any_of(q_.truth.hits, [&](const BagHit& h) { return may(h.triangle, h.truth); });
    const bool touched = std::ranges::any_of(
        q_.truth.stretches, [&](const Stretch& s) { return may(s.triangle, {.hit_class = s.hit_class}); });
    return met || touched ? BagVerdict::unspecified : BagVerdict::correct;
  }

  // The nearest point crossed that must be hit.
  const Group* first_due() const {
    const auto it = std::ranges::find(must_, true);
    return it == must_.end() ? nullptr : &groups_[static_cast<std::size_t>(it - must_.begin())];
  }

  bool any_due() const {
    return first_due() || std::ranges::any_of(q_.truth.stretches, [&](const Stretch& s) { return must(s); });
  }

  BagJudgement nothing_hit() const {
    if (const Group* due = first_due()) return missed(*due);
    return {any_due() ? BagVerdict::leak : quiet()};
  }

  BagJudgement nearest_hit(std::uint32_t triangle) const {
    const VerdictKind here = claim(triangle);
    if (here == VerdictKind::false_hit) {
      BagJudgement wrong = one_wrong(triangle, true);
      wrong.verdict = any_due() ? BagVerdict::wrong_nearest : BagVerdict::false_hit;
      return wrong;
    }
    const BagJudgement fine{here == VerdictKind::correct ? BagVerdict::correct : BagVerdict::unspecified};
    const BagHit* crossed = met(triangle);
    const auto touched = std::ranges::find(q_.truth.stretches, triangle, &Stretch::triangle);
    // What is only touched is surely missed if it ends before this begins: rounding keeps order.
    const double begins = crossed ? crossed->t : touched != q_.truth.stretches.end() ? touched->low : -infinity;
    for (const Stretch& s : q_.truth.stretches)
      if (s.high < begins && must(s)) return behind(piece(s.high, begins));
    const Group* due = first_due();
    if (!due) return fine;
    if (std::ranges::count(*due, triangle, &BagHit::triangle) != 0) return {};
    if (crossed) return crossed->rank > due->front().rank ? behind(apart(due->front().triangle, triangle)) : fine;
    if (touched != q_.truth.stretches.end())
      return due->front().t < begins ? behind(piece(due->front().t, begins)) : fine;
    // Passed by, within the slack.
    const ExactCase reported(q_.triangles[triangle], q_.query), first(q_.triangles[due->front().triangle], q_.query);
    if (reported.det.sign() == 0 || !(reported.t() > first.t())) return fine;
    BagJudgement wrong = apart(due->front().triangle, triangle);
    wrong.verdict = BagVerdict::wrong_nearest;
    return wrong;
  }

  static BagJudgement behind(BagJudgement wrong) {
    wrong.verdict = BagVerdict::wrong_nearest;
    wrong.behind = true;
    return wrong;
  }

  BagJudgement some_hit() const {
    if (any_due()) return {};
    BagJudgement least{BagVerdict::false_hit, infinity, infinity};
    for (std::uint32_t i = 0; i < q_.triangles.size(); ++i) {
      const VerdictKind here = claim(i);
      if (here != VerdictKind::false_hit)
        return {here == VerdictKind::correct ? BagVerdict::correct : BagVerdict::unspecified};
      const BagJudgement wrong = one_wrong(i, true);
      if (wrong.length < least.length) least = wrong;
    }
    return least;
  }

  BagJudgement missed(const Group& group) const {
    BagJudgement worst{BagVerdict::leak};
    for (const BagHit& hit : group) take_worse(worst, one_wrong(hit.triangle, false));
    worst.verdict = BagVerdict::leak;
    return worst;
  }

  // The severity of that answer of one triangle; the verdict is still to be told.
  BagJudgement one_wrong(std::uint32_t triangle, bool answered_hit) const {
    if (!q_.severities) return {BagVerdict::false_hit};
    const auto s = severity(q_.triangles[triangle], q_.query, answered_hit, q_.contract.precision);
    return {BagVerdict::false_hit, s ? s->length : 0, s ? s->ulps : 0};
  }

  // How far apart the ray meets the planes of two triangles.
  BagJudgement apart(std::uint32_t first, std::uint32_t second) const {
    if (!q_.severities) return {BagVerdict::wrong_order};
    const Triangle &p = q_.triangles[first], &q = q_.triangles[second];
    const Quotient s = ExactCase(p, q_.query).t(), t = ExactCase(q, q_.query).t();
    const double largest = largest_magnitude(q_.query.ray.origin, p.a, p.b, p.c, q.a, q.b, q.c);
    return stretch({t.numerator * s.denominator - s.numerator * t.denominator, s.denominator * t.denominator}, largest,
                   BagVerdict::wrong_order);
  }

  BagJudgement stretch(const Quotient& t, double largest, BagVerdict verdict) const {
    const exact::Vec d = exact::to_exact(q_.query.ray.direction) + exact::to_exact(q_.query.direction_tail);
    const Dyadic length2 = square(t.numerator) * square(d),
                 ulp2(1, 2 * ulp_exponent_at(largest, q_.contract.precision));
    return {verdict, exact::rounded_sqrt<double>({length2, square(t.denominator)}),
            exact::rounded_sqrt<double>({length2, square(t.denominator) * ulp2})};
  }

  const BagQuestion& q_;
  std::vector<Group> groups_;
  std::vector<char> must_;  // by group
};

std::optional<BagVerdict> settled(const BagQuestion& q, std::span<const Answer> answers) {
  const auto faulty = [&](const Answer& a) {
    return a.outcome == Outcome::fault || (a.outcome == Outcome::hit && a.triangle >= q.triangles.size());
  };
  if (std::ranges::any_of(answers, faulty)) return BagVerdict::fault;
  if (q.truth.invalid != Invalid::none) return BagVerdict::unspecified;
  return std::nullopt;
}

}  // namespace

VerdictKind verdict_kind(BagVerdict verdict) {
  switch (verdict) {
    case BagVerdict::correct:
      return VerdictKind::correct;
    case BagVerdict::leak:
      return VerdictKind::leak;
    case BagVerdict::false_hit:
      return VerdictKind::false_hit;
    case BagVerdict::wrong_nearest:
      return VerdictKind::wrong_nearest;
    case BagVerdict::unspecified:
      return VerdictKind::unspecified;
    case BagVerdict::fault:
      return VerdictKind::fault;
    default:
      throw std::logic_error("no verdict on what is hit first: " + std::string(name(verdict)));
  }
}

BagJudgement judge_nearest(const BagQuestion& question, const Answer& answer) {
  const DefaultControls controls;
  if (const auto verdict = settled(question, {&answer, 1})) return {*verdict};
  return Judge(question).nearest(answer);
}

BagJudgement judge_hits(const BagQuestion& question, std::span<const Answer> hits) {
  const DefaultControls controls;
  if (const auto verdict = settled(question, hits)) return {*verdict};
  return Judge(question).hits(hits);
}

BagJudgement judge_order(const BagQuestion& question, std::span<const Answer> hits) {
  const DefaultControls controls;
  if (const auto verdict = settled(question, hits)) return {*verdict};
  return Judge(question).order(hits);
}

BagJudgement judge_parity(const BagQuestion& question, std::span<const Answer> hits) {
  const DefaultControls controls;
  if (const auto verdict = settled(question, hits)) return {*verdict};
  return Judge(question).parity(hits);
}

BagJudgement judge_segments(const BagQuestion& question, std::span<const RaySegment> answered,
                            std::span<const RaySegment> exact, double leeway) {
  const DefaultControls controls;
  if (const auto verdict = settled(question, {})) return {*verdict};
  std::vector<double> ends;
  for (const auto& pieces : {answered, exact})
    for (const RaySegment& piece : pieces) ends.insert(ends.end(), {piece.in, piece.out});
  if (std::ranges::any_of(ends, is_nan<double>)) return {BagVerdict::wrong_thickness, infinity, infinity};
  std::ranges::sort(ends);
  const auto holds = [](std::span<const RaySegment> pieces, double low, double high) {
    return std::ranges::any_of(pieces, [&](const RaySegment& p) { return p.in <= low && high <= p.out; });
  };
  const Judge judge(question);
  BagJudgement worst;
  std::array<std::optional<double>, 2> begin;  // of a piece that is in one of them alone
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double low = ends[i], high = ends[i + 1];
    if (low == high) continue;
    const std::array<bool, 2> in = {holds(answered, low, high), holds(exact, low, high)};
    for (std::size_t k = 0; k < 2; ++k) {
      if (!in[k] || in[1 - k]) {
        begin[k].reset();
        continue;
      }
      if (!begin[k]) begin[k] = low;
      const BagJudgement here = judge.piece(*begin[k], high);
      if (here.length > leeway && here.length > worst.length) worst = here;
    }
  }
  return worst;
}

bool lost_by_culling(const BagJudgement& judgement, const BagTruth& truth, const Answer& answer,
                     std::span<const Answer> hits_alone) {
  const DefaultControls controls;
  const bool leak = judgement.verdict == BagVerdict::leak;
  if (!leak && judgement.verdict != BagVerdict::wrong_nearest) return false;
  return std::ranges::any_of(hits_alone, [&](const Answer& alone) {
    const auto crossed = std::ranges::find(truth.hits, alone.triangle, &BagHit::triangle);
    if (crossed == truth.hits.end()) return false;
    return leak || (crossed->rank == judgement.due_rank && alone.has_t && answer.has_t && alone.t < answer.t);
  });
}

}  // namespace plumbline
