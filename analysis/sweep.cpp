#include "analysis/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <mutex>

#include "analysis/ask.h"
#include "case/input_error.h"
#include "case/precision.h"
#include "oracle/classify.h"
#include "oracle/judge.h"

namespace plumbline {
namespace {

// Small enough to stop soon, large enough for handing out to cost nothing.
constexpr std::uint64_t batch_size = 16;

// Tracers of one precision that search the same range are asked the same questions: these share rays and truths.
struct Audience {
  Contract contract;  // of any of them, as far as precision and range go
  std::vector<std::size_t> tracers;
};

bool asked_the_same(const Contract& p, const Contract& q) {
  return p.precision == q.precision && searched_ray(Ray{}, p) == searched_ray(Ray{}, q);
}

std::vector<Audience> audiences_of(const std::vector<const Tracer*>& tracers) {
  std::vector<Audience> list;
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const Contract& contract = tracers[i]->info().contract;
    auto it = std::ranges::find_if(list, [&](const Audience& a) { return asked_the_same(a.contract, contract); });
    if (it == list.end()) it = list.insert(it, {contract, {}});
    it->tracers.push_back(i);
  }
  return list;
}

Aiming aiming_at(const SweepPlan& plan, double standoff) {
  return {.tolerances = plan.tolerances, .standoff = standoff, .normal = plan.normal};
}

// What stays the same for all triangles. A shot is one ray of a triangle: those of all standoffs follow each other.
struct Layout {
  explicit Layout(const SweepPlan& plan) : audiences(audiences_of(plan.tracers)) {
    for (const double standoff : plan.standoffs) {
      aimings.push_back(aiming_at(plan, standoff));
      for (const Aim& aim : aims(aimings.back())) {
        const bool new_row = shots.empty() || shots.back().target != aim.target ||
                             shots.back().tolerance != aim.tolerance || shots.back().standoff != aim.standoff;
        if (new_row) row_starts.push_back(shots.size());
        shots.push_back(aim);
        row_of_shot.push_back(row_starts.size() - 1);
      }
    }
  }
  std::size_t rows_per_lattice() const { return row_starts.size(); }

  std::vector<Audience> audiences;
  std::vector<Aiming> aimings;  // one for each standoff
  std::vector<Aim> shots;
  std::vector<std::size_t> row_of_shot, row_starts;
};

// One thread's share of the work, with its buffers.
class Worker {
 public:
  Worker(const SweepPlan& plan, const Layout& layout)
      : plan_(plan),
        layout_(layout),
        bag_(plan.object),
        rays_(layout.shots.size()),
        asked_(rays_.size()),
        searched_(rays_.size()),
        truths_(rays_.size()),
        answers_(rays_.size()),
        tallies_(plan.tracers.size() * plan.lattices.size() * layout.rows_per_lattice()),
        conduct_(plan.tracers.size()) {
    bag_.triangles.resize(1);
  }

  void run(std::uint64_t index) {
    const LatticeTriple triple = triple_at(plan_.lattices.front(), index);
    if (collinear(triple)) return;
    ++triangles_;
    for (std::size_t i = 0; i < plan_.lattices.size(); ++i) shoot_at(triangle_of(plan_.lattices[i], triple), i);
  }

  const std::vector<Tally>& tallies() const { return tallies_; }
  const std::vector<Conduct>& conduct() const { return conduct_; }
  std::uint64_t triangles() const { return triangles_; }

 private:
  void shoot_at(const Triangle& triangle, std::size_t lattice) {
    std::span<Ray> rest = rays_;
    for (const Aiming& aiming : layout_.aimings) {
      const std::size_t n = rays_.size() / layout_.aimings.size();
      aim_rays(triangle, aiming, rest.first(n));
      rest = rest.subspan(n);
    }
    for (const Audience& audience : layout_.audiences) {
      const Precision precision = audience.contract.precision;
      bag_.triangles[0] = triangle;
      const Bag bag = at_precision(bag_, precision);
      for (std::size_t i = 0; i < rays_.size(); ++i) {
        asked_[i] = at_precision(rays_[i], precision);
        searched_[i] = searched_ray(asked_[i], audience.contract).ray;
      }
      classify(bag.triangles[0], searched_, truths_);
      for (const std::size_t tracer : audience.tracers) shoot_with(tracer, bag, lattice);
    }
  }

  void shoot_with(std::size_t tracer, const Bag& bag, std::size_t lattice) {
    const TracerInfo& info = plan_.tracers[tracer]->info();
    const auto prepared = plan_.tracers[tracer]->prepare(bag);
    prepared->trace(asked_, answers_);
    const std::size_t rows = layout_.rows_per_lattice();
    const auto tallies = std::span(tallies_).subspan((tracer * plan_.lattices.size() + lattice) * rows, rows);
    const Triangle& triangle = bag.triangles[0];
    for (std::size_t i = 0; i < asked_.size(); ++i) {
      const Query query = info.own_queries ? prepared->asked(asked_[i]) : asked_[i];
      const Truth truth = info.own_queries ? classify(triangle, searched_ray(query, info.contract)) : truths_[i];
      const VerdictKind verdict = judge(triangle, query, truth, answers_[i], info.contract);
      count(tallies[layout_.row_of_shot[i]], layout_.shots[i].wish, right_answer(triangle, query, truth, info.contract),
            answers_[i].outcome, verdict);
      if (plan_.on_wrong && wrong(verdict))
        tell_wrong(*plan_.tracers[tracer], bag, i, query);
    }
    conduct_[tracer] += prepared->conduct();
  }

  [[gnu::cold]] void tell_wrong(const Tracer& tracer, const Bag& bag, std::size_t shot, const Query& query) const {
    Case what;
    what.precision = tracer.info().contract.precision;
    what.bag = bag;
    what.ray = asked_[shot];
    what.aim = layout_.shots[shot];
    plan_.on_wrong({tracer, what, query, answers_[shot]});
  }

  const SweepPlan& plan_;
  const Layout& layout_;
  Bag bag_;
  std::vector<Ray> rays_;      // as aimed
  std::vector<Ray> asked_;     // at the audience's precision
  std::vector<Ray> searched_;  // with the range that its contracts say
  std::vector<Truth> truths_;
  std::vector<Answer> answers_;
  std::vector<Tally> tallies_;  // by tracer, lattice, row
  std::vector<Conduct> conduct_;  // by tracer
  std::uint64_t triangles_ = 0;
};

template <class Values, class Print>
void check_distinct(const Values& values, std::string_view what, Print print) {
  for (auto it = values.begin(); it != values.end(); ++it)
    if (std::find(values.begin(), it, *it) != it)
      throw InputError(fmt::format("{} {}: given twice; give it once", what, print(*it)));
}

}  // namespace

void check(const SweepPlan& plan) {
  check_distinct(plan.standoffs, "standoff", std::identity{});
  check_distinct(plan.tolerances, "tolerance", std::identity{});
  check_distinct(plan.tracers, "tracer", [](const Tracer* tracer) { return tracer->info().name; });
  check_distinct(plan.lattices, "offset", [](const Lattice& lattice) {
    const Vec3 offset = offset_of(lattice);
    return fmt::format("{} {} {}", offset.x, offset.y, offset.z);
  });
  for (const double standoff : plan.standoffs) check(aiming_at(plan, standoff));
  if (plan.object.mode == BagMode::plate && !(plan.object.thickness > 0))
    throw InputError(
        fmt::format("thickness {}: not positive; give a plate's thickness such as 0.1", plan.object.thickness));
}

SweepResult sweep(const SweepPlan& plan, const std::atomic<bool>& stop, const SweepProgress& progress) {
  const Layout layout(plan);
  std::mutex mutex;
  std::uint64_t next = plan.triples.first, done = 0;  // under the mutex

  // Batches are handed out in order and finished once begun: what is done has no gap.
  const auto take_batch = [&](std::uint64_t finished) -> TripleRange {
    const std::lock_guard lock(mutex);
    done += finished;
    if (finished != 0 && progress) progress(done, plan.triples.end - plan.triples.first);
    const std::uint64_t begin = next;
    if (!stop) next += std::min(batch_size, plan.triples.end - begin);
    return {begin, next};
  };
  const auto work = [&] {
    Worker worker(plan, layout);
    for (TripleRange batch = take_batch(0); batch.first != batch.end; batch = take_batch(batch.end - batch.first))
      for (std::uint64_t i = batch.first; i < batch.end; ++i) worker.run(i);
    return worker;
  };
  std::vector<std::future<Worker>> workers;
  for (unsigned i = 0; i < std::max(1u, plan.jobs); ++i) workers.push_back(std::async(std::launch::async, work));

  SweepResult result;
  for (const Tracer* tracer : plan.tracers)
    for (const Lattice& lattice : plan.lattices)
      for (const std::size_t start : layout.row_starts) {
        const Aim& aim = layout.shots[start];
        result.rows.push_back({tracer, offset_of(lattice), aim.standoff, aim.target, aim.tolerance, {}});
      }
  result.conduct.resize(plan.tracers.size());
  for (auto& future : workers) {
    const Worker worker = future.get();
    for (std::size_t i = 0; i < plan.tracers.size(); ++i) result.conduct[i] += worker.conduct()[i];
    result.triangles += worker.triangles();
    for (std::size_t i = 0; i < result.rows.size(); ++i) result.rows[i].tally += worker.tallies()[i];
  }
  result.done = {plan.triples.first, next};
  return result;
}

}  // namespace plumbline
