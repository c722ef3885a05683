#include "analysis/watertight.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <future>
#include <map>
#include <mutex>

#include "case/input_error.h"
#include "oracle/bag/judge.h"
#include "oracle/bag/scene.h"
#include "oracle/judge.h"

namespace plumbline {
namespace {

constexpr std::size_t small_bag = 32;  // triangles

constexpr int ulp = 1, exact = 0;

// With full mantissas; exactly, in binary32 on a grid so coarse that products of three differences are floats.
constexpr LeakTest test(LeakTable table, std::string_view name, BagFamily family, std::array<BagTarget, 2> targets,
                        BagOrigin origin, Precision precision, int ulps) {
  const int bits = precision == Precision::binary64 ? 53 : ulps == 0 ? 8 : 24;
  return {table, name, family, targets, origin, precision, bits, ulps};
}

constexpr auto tests_at(Precision p) {
  using enum LeakTable;
  using enum BagFamily;
  using enum BagTarget;
  using enum BagOrigin;
  return std::array{test(shared, "pair, ulp", pair, {edge, edge}, outside, p, ulp),
                    test(shared, "pair, exact", pair, {edge, edge}, outside, p, exact),
                    test(shared, "fan, ulp", fan, {vertex, edge}, outside, p, ulp),
                    test(shared, "fan, exact", fan, {vertex, edge}, outside, p, exact),
                    test(shared, "strip, ulp", strip, {vertex, edge}, outside, p, ulp),
                    test(shared, "strip, exact", strip, {vertex, edge}, outside, p, exact),
                    test(spheres, "sphere, vertices", sphere, {vertex, vertex}, inside, p, ulp),
                    test(spheres, "sphere, edges", sphere, {edge, edge}, inside, p, ulp),
                    test(spheres, "sphere, outside", sphere, {vertex, edge}, outside, p, ulp),
                    test(layered, "sheets", sheets, {face, edge}, outside, p, ulp),
                    test(layered, "overlap", overlap, {face, edge}, outside, p, ulp),
                    test(layered, "lattice", lattice, {edge, vertex}, outside, p, exact),
                    test(layered, "grazing pair", pair, {edge, face}, grazing, p, ulp),
                    test(layered, "grazing sphere", sphere, {vertex, edge}, grazing, p, ulp)};
}

constexpr auto all_tests = [] {
  constexpr auto narrow = tests_at(Precision::binary32), wide = tests_at(Precision::binary64);
  std::array<LeakTest, narrow.size() + wide.size()> list;
  std::ranges::copy(wide, std::ranges::copy(narrow, list.begin()).out);
  return list;
}();

std::uint64_t rays_of_a_bag(BagFamily family) {
  return family == BagFamily::sphere ? 1000 : family == BagFamily::lattice ? 4 : 16;
}

std::uint64_t bags_of(const LeakTest& test, const LeakPlan& plan) {
  const std::uint64_t rays = rays_of_a_bag(test.family);
  return (plan.rays + rays - 1) / rays;
}

// All over the lattice, where there are fewer bags than it has; else each the next time at the other target.
std::uint64_t bag_of(const LeakTest& test, const LeakPlan& plan, std::uint64_t index) {
  const std::uint64_t bags = bags_of(test, plan);
  return test.family == BagFamily::lattice && bags < lattice_bags ? index * lattice_bags / bags : index;
}

bool reads(const Tracer& tracer, const LeakTest& test) {
  return test.precision == Precision::binary32 || tracer.info().contract.precision == Precision::binary64;
}

void check(const LeakPlan& plan) {
  if (plan.tracers.empty()) throw InputError("no tracer to ask; name one or more with --tracer, or 'all'");
  if (plan.rays == 0) throw InputError("no ray to ask; give --rays 1 or more");
  for (std::size_t i = 0; i < plan.tracers.size(); ++i)
    if (std::ranges::count(plan.tracers, plan.tracers[i]) > 1)
      throw InputError(fmt::format("tracer '{}' is named twice", plan.tracers[i]->info().name));
}

// For each triangle the rays to ask it, when it is asked alone.
using Visits = std::vector<std::vector<std::uint32_t>>;

Visits visits_of(const AimedBag& bag, const std::vector<BagTruth>& truths) {
  Visits visits(bag.triangles.size());
  std::map<std::array<double, 3>, std::vector<std::uint32_t>> around;  // a vertex
  const auto corners = [&](std::uint32_t i) {
    const auto& [a, b, c] = bag.triangles[i];
    return std::array{std::array{a.x, a.y, a.z}, std::array{b.x, b.y, b.z}, std::array{c.x, c.y, c.z}};
  };
  const bool small = bag.triangles.size() <= small_bag;
  for (std::uint32_t i = 0; i < bag.triangles.size() && !small; ++i)
    for (const auto& corner : corners(i)) around[corner].push_back(i);
  for (std::uint32_t ray = 0; ray < truths.size(); ++ray) {
    const auto visit = [&](std::uint32_t triangle) {
      auto& list = visits[triangle];
      if (list.empty() || list.back() != ray) list.push_back(ray);
    };
    if (small || truths[ray].hits.empty()) {
      for (std::uint32_t i = 0; i < visits.size(); ++i) visit(i);
      continue;
    }
    for (const BagHit& hit : truths[ray].hits)
      for (const auto& corner : corners(hit.triangle)) std::ranges::for_each(around[corner], visit);
  }
  return visits;
}

// As if it promised that nothing is lost at edges and ends of the range, and nothing widened.
Contract strict(Contract contract) {
  contract.edges = EdgeRule::closed;
  contract.t_min = contract.t_max = EndRule::closed;
  contract.slack_absolute = contract.slack_relative = 0;
  return contract;
}

// Tracers that search the same range, and are asked the rays themselves, share them.
struct Questions {
  RangeRule range;
  std::vector<Query> queries;  // as searched
  std::vector<BagTruth> truths;
  Visits visits;
};

bool same_line(const Query& p, const Query& q) {
  return p.ray.origin == q.ray.origin && p.ray.direction == q.ray.direction && p.direction_tail == q.direction_tail;
}

// What a tracer says of the rays of one bag.
struct Replies {
  std::vector<Answer> whole;
  std::vector<std::vector<Answer>> alone;  // the hits of triangles asked one by one
  std::vector<char> apart, faulty;         // alone
};

// One bag at a time.
class Worker {
 public:
  explicit Worker(const LeakPlan& plan)
      : plan_(plan),
        scores_(plan.tracers.size(), std::vector<LeakScore>(all_tests.size())),
        conduct_(plan.tracers.size()) {}

  void run(std::size_t test, std::uint64_t index) {
    const LeakTest& t = all_tests[test];
    const std::uint64_t pass = index / lattice_bags;
    const BagAim aim{.target = t.targets[(index + pass) % 2],
                     .origin = t.origin,
                     .precision = t.precision,
                     .bits = t.bits,
                     .ulps = t.ulps};
    const std::uint64_t most = rays_of_a_bag(t.family);
    const AimedBag bag =
        draw(t.family, aim, std::min(most, plan_.rays - index * most), plan_.seed, bag_of(t, plan_, index));
    const Scene scene(bag.triangles);
    std::vector<Questions> questions;
    for (std::size_t i = 0; i < plan_.tracers.size(); ++i)
      if (reads(*plan_.tracers[i], t)) ask(i, bag, scene, questions, scores_[i][test]);
  }

  const std::vector<std::vector<LeakScore>>& scores() const { return scores_; }
  const std::vector<Conduct>& conduct() const { return conduct_; }

 private:
  static Questions questions_of(const AimedBag& bag, const Scene& scene, const Contract& contract, const auto& asked) {
    Questions q{.range = contract.range, .queries = {}, .truths = {}, .visits = {}};
    for (const Ray& ray : bag.rays) {
      q.queries.push_back(searched_ray(asked(ray), contract));
      q.truths.push_back(scene.truth(q.queries.back()));
    }
    q.visits = visits_of(bag, q.truths);
    return q;
  }

  void ask(std::size_t tracer, const AimedBag& bag, const Scene& scene, std::vector<Questions>& shared,
           LeakScore& score) {
    const Tracer& asked = *plan_.tracers[tracer];
    const Contract& contract = asked.info().contract;
    const auto whole = asked.prepare({.triangles = bag.triangles});
    if (asked.info().own_queries) {
      const auto own = questions_of(bag, scene, contract, [&](const Ray& ray) { return whole->asked(ray); });
      return count(tracer, bag, *whole, own, score);
    }
    auto it = std::ranges::find(shared, contract.range, &Questions::range);
    if (it == shared.end()) it = shared.insert(it, questions_of(bag, scene, contract, std::identity()));
    count(tracer, bag, *whole, *it, score);
  }

  void count(std::size_t tracer, const AimedBag& bag, PreparedBag& whole, const Questions& questions,
             LeakScore& score) {
    const Replies replies = replies_of(tracer, bag, whole, questions);
    const Contract& contract = plan_.tracers[tracer]->info().contract;
    for (std::size_t i = 0; i < bag.rays.size(); ++i)
      count(replies, i, {bag.triangles, questions.queries[i], questions.truths[i], contract}, bag.closed, score);
  }

  Replies replies_of(std::size_t tracer, const AimedBag& bag, PreparedBag& whole, const Questions& questions) {
    const Tracer& asked = *plan_.tracers[tracer];
    const Contract& contract = asked.info().contract;
    const std::size_t rays = bag.rays.size();
    Replies replies{.whole = std::vector<Answer>(rays),
                    .alone = std::vector<std::vector<Answer>>(rays),
                    .apart = std::vector<char>(rays),
                    .faulty = std::vector<char>(rays)};
    whole.trace(bag.rays, replies.whole);
    conduct_[tracer] += whole.conduct();

    std::vector<Ray> put;
    std::vector<Answer> answers;
    for (std::uint32_t triangle = 0; triangle < bag.triangles.size(); ++triangle) {
      const auto& visits = questions.visits[triangle];
      if (visits.empty()) continue;
      put.clear();
      for (const std::uint32_t ray : visits) put.push_back(bag.rays[ray]);
      answers.assign(put.size(), {});
      const auto alone = asked.prepare({.triangles = {bag.triangles[triangle]}});
      alone->trace(put, answers);
      for (std::size_t i = 0; i < put.size(); ++i) {
        const std::uint32_t ray = visits[i];
        if (asked.info().own_queries &&
            !same_line(searched_ray(alone->asked(put[i]), contract), questions.queries[ray]))
          replies.apart[ray] = 1;
        if (answers[i].outcome == Outcome::fault) replies.faulty[ray] = 1;
        if (answers[i].outcome != Outcome::hit) continue;
        answers[i].triangle = triangle;
        replies.alone[ray].push_back(answers[i]);
      }
      conduct_[tracer] += alone->conduct();
    }
    return replies;
  }

  static void add(LeakCount& count, const BagJudgement& all, const BagJudgement& by_contract, BagVerdict kind) {
    count.all += all.verdict == kind;
    if (by_contract.verdict != kind) return;
    ++count.broken;
    count.worst = std::max(count.worst, by_contract.ulps);
  }

  static void count(const Replies& replies, std::size_t ray, const BagQuestion& question, bool closed,
                    LeakScore& score) {
    ++score.rays;
    const Contract demanding = strict(question.contract);
    const BagQuestion strictly{question.triangles, question.query, question.truth, demanding, false};
    // What nothing is wrong with then is right by the contract as well, unless that asks for fewer hits.
    const bool fewer = question.contract.edges == EdgeRule::open || question.contract.edges == EdgeRule::one_owner;
    const auto judge_both = [&](const auto& judge) {
      const BagJudgement all = judge(strictly);
      const bool fine = all.verdict == BagVerdict::correct || all.verdict == BagVerdict::unspecified;
      return std::pair(all, fine && !fewer ? all : judge(question));
    };
    const std::vector<Answer>& alone = replies.alone[ray];
    const Answer& whole = replies.whole[ray];
    const bool apart = replies.apart[ray] != 0, faulty = replies.faulty[ray] != 0;
    score.apart += apart;
    score.faults += faulty || whole.outcome == Outcome::fault;
    if (!apart && !faulty) {
      const auto [all, by_contract] = judge_both([&](const BagQuestion& q) { return judge_hits(q, alone); });
      add(score.leaks, all, by_contract, BagVerdict::leak);
      add(score.doubles, all, by_contract, BagVerdict::double_hit);
      add(score.displaced, all, by_contract, BagVerdict::wrong_nearest);
      const BagJudgement order = judge_order(question, alone);
      add(score.order, order, order, BagVerdict::wrong_order);
    }
    if (!apart && !faulty && closed) {
      const auto [all, by_contract] = judge_both([&](const BagQuestion& q) { return judge_parity(q, alone); });
      add(score.parity, all, by_contract, BagVerdict::wrong_parity);
    }
    const auto [all, by_contract] = judge_both([&](const BagQuestion& q) { return judge_nearest(q, whole); });
    add(score.bag_leaks, all, by_contract, BagVerdict::leak);
    add(score.nearest, all, by_contract, BagVerdict::wrong_nearest);
    add(score.false_hits, all, by_contract, BagVerdict::false_hit);
    const bool culled = !apart && lost_by_culling(all, question.truth, whole, alone);
    (all.verdict == BagVerdict::leak ? score.culled_leaks : score.culled_nearest) += culled;
  }

  const LeakPlan& plan_;
  std::vector<std::vector<LeakScore>> scores_;
  std::vector<Conduct> conduct_;
};

// A bag. They take turns so that what is done of an interrupted run is some of each test.
struct Turn {
  std::size_t test;
  std::uint64_t index;
};

std::vector<Turn> turns_of(const LeakPlan& plan) {
  std::vector<Turn> list;
  for (std::size_t test = 0; test < all_tests.size(); ++test) {
    if (std::ranges::none_of(plan.tracers, [&](const Tracer* t) { return reads(*t, all_tests[test]); })) continue;
    for (std::uint64_t i = 0; i < bags_of(all_tests[test], plan); ++i) list.push_back({test, i});
  }
  const auto share = [&](const Turn& turn) {
    return std::pair(static_cast<double>(turn.index) / static_cast<double>(bags_of(all_tests[turn.test], plan)),
                     turn.test);
  };
  std::ranges::sort(list, {}, share);
  return list;
}

}  // namespace

LeakCount& LeakCount::operator+=(const LeakCount& more) {
  all += more.all;
  broken += more.broken;
  worst = std::max(worst, more.worst);
  return *this;
}

LeakScore& LeakScore::operator+=(const LeakScore& more) {
  rays += more.rays;
  leaks += more.leaks;
  doubles += more.doubles;
  displaced += more.displaced;
  order += more.order;
  parity += more.parity;
  apart += more.apart;
  bag_leaks += more.bag_leaks;
  nearest += more.nearest;
  false_hits += more.false_hits;
  culled_leaks += more.culled_leaks;
  culled_nearest += more.culled_nearest;
  faults += more.faults;
  return *this;
}

std::span<const LeakTest> leak_tests() { return all_tests; }

LeakResult find_leaks(const LeakPlan& plan, const std::atomic<bool>& stop, const LeakProgress& progress) {
  check(plan);
  const std::vector<Turn> bags = turns_of(plan);
  std::mutex mutex;
  std::size_t next = 0, done = 0;  // under the mutex
  const auto take = [&](std::size_t finished) -> const Turn* {
    const std::lock_guard lock(mutex);
    done += finished;
    if (finished != 0 && progress) progress(done, bags.size());
    return stop || next == bags.size() ? nullptr : &bags[next++];
  };
  const auto work = [&] {
    Worker worker(plan);
    for (const Turn* bag = take(0); bag; bag = take(1)) worker.run(bag->test, bag->index);
    return worker;
  };
  std::vector<std::future<Worker>> workers;
  for (unsigned i = 0; i < std::max(1u, plan.jobs); ++i) workers.push_back(std::async(std::launch::async, work));

  LeakResult result{.plan = plan,
                    .scores = std::vector(plan.tracers.size(), std::vector<LeakScore>(all_tests.size())),
                    .conduct = std::vector<Conduct>(plan.tracers.size()),
                    .planned = bags.size()};
  for (auto& future : workers) {
    const Worker worker = future.get();
    for (std::size_t i = 0; i < plan.tracers.size(); ++i) {
      result.conduct[i] += worker.conduct()[i];
      for (std::size_t k = 0; k < all_tests.size(); ++k) result.scores[i][k] += worker.scores()[i][k];
    }
  }
  result.done = done;
  return result;
}

}  // namespace plumbline
