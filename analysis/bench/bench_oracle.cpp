#include "analysis/bench/bench_oracle.h"

#include <algorithm>
#include <memory>

#include "analysis/bench/interleaved.h"
#include "analysis/bench/naive_batch.h"
#include "analysis/bench/naive_scalar.h"
#include "analysis/bench/rivals/rivals.h"
#include "oracle/accumulator.h"
#include "oracle/classify.h"
#include "oracle/integer.h"
#include "oracle/measure.h"
#include "oracle/severity.h"

namespace plumbline {
namespace {

struct Score {
  std::optional<double> undecided;
  std::size_t wrong = 0;
};

struct Method {
  std::string name;
  Answers answers = Answers::truth;
  bool exact = true;
  Timed timed;
  std::function<Score()> score;  ///< of the answers of the last pass
};

// ---- one case per call

// No std::vector<bool>.
unsigned char naive_byte(const Triangle& triangle, const Ray& ray) { return naive_scalar(triangle, ray); }

struct FullTruth {
  Truth truth;
  std::optional<Coordinates<double>> at;
};

FullTruth full_truth(const Triangle& triangle, const Ray& ray) {
  FullTruth full{classify(triangle, ray), {}};
  if (crosses(full.truth)) full.at = measure<double>(triangle, ray);
  return full;
}

struct SevereTruth {
  Truth truth;
  std::optional<Severity> severity;
};

// Of the answer that is wrong.
SevereTruth severe_truth(const Triangle& triangle, const Ray& ray) {
  const Truth truth = classify(triangle, ray);
  return {truth, severity(triangle, ray, !crosses(truth), Precision::binary64)};
}

// What is answered, as far as it is decided.
Truth answered(unsigned char hit) { return hit_or_miss(hit != 0); }
Truth answered(const Truth& truth) { return truth; }
Truth answered(const FullTruth& full) { return full.truth; }
Truth answered(const SevereTruth& severe) { return severe.truth; }
std::optional<Truth> answered(const std::optional<Truth>& truth) { return truth; }

template <class Ask>
Method one_by_one(std::string name, Answers answers, const JudgedShots& judged, Ask ask) {
  using Answer = decltype(ask(Triangle{}, Ray{}));
  const auto got = std::make_shared<std::vector<Answer>>(judged.shots.size());
  const auto pass = [&judged, got, ask] {
    for (std::size_t i = 0; i < got->size(); ++i) (*got)[i] = ask(judged.shots[i].triangle, judged.shots[i].ray);
  };
  const auto score = [&judged, got, answers] {
    Score found;
    std::size_t undecided = 0;
    for (std::size_t i = 0; i < got->size(); ++i) {
      const std::optional<Truth> answer = answered((*got)[i]);
      if (!answer)
        ++undecided;
      else if (is_wrong(answers, *answer, judged.truths[i]))
        ++found.wrong;
    }
    if (std::is_same_v<Answer, std::optional<Truth>>)
      found.undecided = static_cast<double>(undecided) / static_cast<double>(got->size());
    return found;
  };
  return {.name = std::move(name), .answers = answers, .timed = {pass, judged.shots.size()}, .score = score};
}

// ---- batches in columns

Method naive_lanes(std::string name, const JudgedShots& judged, const Batch& batch, Isa isa) {
  const NaiveBatch kernel = naive_batch(isa);
  const auto hits = std::make_shared<std::vector<std::uint8_t>>(batch.size / kernel.lanes);
  const auto score = [&judged, kernel, hits] {
    Score found;
    for (std::size_t i = 0; i < judged.truths.size(); ++i)
      if (is_wrong(Answers::hit, hit_or_miss(((*hits)[i / kernel.lanes] >> i % kernel.lanes & 1) != 0),
                   judged.truths[i]))
        ++found.wrong;
    return found;
  };
  return {.name = std::move(name),
          .answers = Answers::hit,
          .exact = false,
          .timed = {[kernel, batch, hits] { kernel.run(batch, hits->data()); }, batch.size},
          .score = score};
}

Method exact_lanes(std::string name, const JudgedShots& judged, Batch batch, Isa isa) {
  const auto truths = std::make_shared<std::vector<Truth>>(batch.size);
  batch.truths = truths->data();
  const auto score = [&judged, truths, batch, isa] {
    StageCounts counts;
    classify(batch, isa, &counts);
    Score found;
    const std::size_t decided = batch.skip_filter ? counts.residue : counts.filter;
    found.undecided = 1 - static_cast<double>(decided) / static_cast<double>(batch.size);
    for (std::size_t i = 0; i < batch.size; ++i)
      if (is_wrong(Answers::truth, (*truths)[i], judged.truths[i])) ++found.wrong;
    return found;
  };
  return {.name = std::move(name),
          .timed = {[truths, batch, isa] { classify(batch, isa, nullptr); }, batch.size},
          .score = score};
}

// ---- a workload

bool has_area(const Truth& truth) { return truth.invalid == Invalid::none && truth.hit_class != HitClass::degenerate; }

template <class Keep>
JudgedShots part_of(const JudgedShots& judged, std::size_t most, Keep keep) {
  JudgedShots part;
  for (std::size_t i = 0; i < judged.shots.size() && part.shots.size() < most; ++i) {
    if (!keep(judged.truths[i])) continue;
    part.shots.push_back(judged.shots[i]);
    part.truths.push_back(judged.truths[i]);
  }
  return part;
}

// The methods of a workload, with the cases that they refer to.
struct Bench {
  JudgedShots judged, of_one, valid, for_rivals, with_area;
  std::optional<Columns> columns, columns_of_one;
  std::vector<Method> methods;
};

void add_batches(Bench& bench, Isa isa) {
  bench.columns.emplace(bench.judged.shots);
  const Batch batch = bench.columns->batch();
  bench.methods.push_back(naive_lanes("naive_batch", bench.judged, batch, isa));
  bench.methods.push_back(exact_lanes("exact_batch", bench.judged, batch, isa));
}

void add_batches_of_one_triangle(Bench& bench, Isa isa) {
  const auto proper = std::find_if(bench.judged.truths.begin(), bench.judged.truths.end(), has_area);
  if (proper == bench.judged.truths.end()) return;
  const auto at = static_cast<std::size_t>(proper - bench.judged.truths.begin());
  bench.of_one = with_triangle(bench.judged, bench.judged.shots[at].triangle);
  bench.columns_of_one.emplace(bench.of_one.shots);
  Batch batch = bench.columns_of_one->batch();
  batch.one_triangle = true;
  bench.methods.push_back(naive_lanes("naive_batch_one_triangle", bench.of_one, batch, isa));
  bench.methods.push_back(exact_lanes("exact_batch_one_triangle", bench.of_one, batch, isa));
}

void add_stages(Bench& bench, Isa isa) {
  Batch batch = bench.columns->batch();
  batch.skip_filter = true;
  bench.methods.push_back(exact_lanes("exact_batch_without_filter", bench.judged, batch, isa));
  bench.valid =
      part_of(bench.judged, bench.judged.shots.size(), [](const Truth& t) { return t.invalid == Invalid::none; });
  bench.methods.push_back(one_by_one("integer", Answers::truth, bench.valid,
                                     [](const Triangle& t, const Ray& r) { return classify_integer(t, r); }));
  bench.methods.push_back(one_by_one("accumulate", Answers::truth, bench.valid, classify_accumulate));
}

void add_rivals(Bench& bench, std::size_t cases) {
  bench.for_rivals = part_of(bench.judged, cases, [](const Truth&) { return true; });
  bench.with_area = part_of(bench.judged, cases, has_area);
  for (const Rival& rival : rivals()) {
    const JudgedShots& judged = rival.needs_area ? bench.with_area : bench.for_rivals;
    if (judged.shots.empty()) continue;
    bench.methods.push_back(one_by_one(std::string(rival.name), rival.answers, judged, rival.ask));
    bench.methods.back().exact = rival.exact;
  }
}

// References into the Bench are kept by its methods: it doesn't move.
void fill(Bench& bench, const BenchPlan& plan, const WorkloadPlan& workload) {
  const std::size_t cases = workload.from_memory ? plan.memory_cases : plan.cases;
  bench.judged = draw_judged(workload, plan.seed, cases, plan.t_max);
  bench.methods.push_back(one_by_one("naive_scalar", Answers::hit, bench.judged, naive_byte));
  bench.methods.back().exact = false;
  add_batches(bench, plan.isa);
  if (workload.unpaired) add_batches_of_one_triangle(bench, plan.isa);
  bench.methods.push_back(one_by_one("exact_single", Answers::truth, bench.judged,
                                     [](const Triangle& t, const Ray& r) { return classify(t, r); }));
  if (workload.from_memory) return;
  add_stages(bench, plan.isa);
  bench.methods.push_back(one_by_one("full_truth", Answers::truth, bench.judged, full_truth));
  bench.methods.push_back(one_by_one("truth_and_severity", Answers::truth, bench.judged, severe_truth));
  add_rivals(bench, plan.rival_cases);
}

std::vector<BenchRow> run(const Bench& bench, const BenchPlan& plan, std::string_view workload) {
  std::vector<Timed> timed;
  for (const Method& method : bench.methods) timed.push_back(method.timed);
  const auto ns = interleaved_ns(timed, plan.rounds, plan.slice_seconds);
  const auto ratio = [&](std::vector<double> of, std::string_view to) {
    const auto found = std::ranges::find(bench.methods, to, &Method::name);
    const auto& base = ns[static_cast<std::size_t>(found - bench.methods.begin())];
    for (std::size_t round = 0; round < of.size(); ++round) of[round] /= base[round];
    return median(std::move(of));
  };
  std::vector<BenchRow> rows;
  for (std::size_t k = 0; k < bench.methods.size(); ++k) {
    const Method& method = bench.methods[k];
    const auto naive_batch = method.name.ends_with("_one_triangle") ? "naive_batch_one_triangle" : "naive_batch";
    const Score score = method.score();
    rows.push_back({.workload = std::string(workload),
                    .method = method.name,
                    .answers = method.answers,
                    .exact = method.exact,
                    .cases = method.timed.cases,
                    .ns_median = median(ns[k]),
                    .ratio_to_naive_batch = ratio(ns[k], naive_batch),
                    .ratio_to_naive_scalar = ratio(ns[k], "naive_scalar"),
                    .undecided = score.undecided,
                    .wrong = score.wrong});
  }
  return rows;
}

}  // namespace

BenchResult bench_oracle(const BenchPlan& plan, const BenchProgress& progress) {
  BenchResult result{.plan = plan, .rows = {}, .worst = {}};
  for (const WorkloadPlan& workload : plan.workloads) {
    progress(workload.name);
    Bench bench;
    fill(bench, plan, workload);
    for (BenchRow& row : run(bench, plan, workload.name)) result.rows.push_back(std::move(row));
  }
  if (plan.search_seconds > 0) {
    progress("search for the worst case");
    const WorstCase worst = search_worst_case(plan.seed, plan.search_seconds);
    const auto& [triangle, ray] = worst.shot;
    result.worst_is_wrong = classify(triangle, ray) != ask_mpq(triangle, ray);
    result.worst = worst;
  }
  return result;
}

}  // namespace plumbline
