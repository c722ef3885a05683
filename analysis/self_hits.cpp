#include "analysis/self_hits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <future>
#include <mutex>

#include "case/input_error.h"
#include "case/precision.h"
#include "case/random.h"
#include "oracle/classify.h"

namespace plumbline {
namespace {

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
Vec3 scaled(const Vec3& v, double k) { return {k * v.x, k * v.y, k * v.z}; }
Vec3 sum(const Vec3& v, const Vec3& w) { return {v.x + w.x, v.y + w.y, v.z + w.z}; }
Vec3 way(const Vec3& from, const Vec3& to) { return {to.x - from.x, to.y - from.y, to.z - from.z}; }

// Uniform over the ball, so that its direction is over the sphere.
Vec3 in_ball(Random& random) {
  for (;;) {
    const double x = random.unit(), y = random.unit(), z = random.unit();
    if (const double square = x * x + y * y + z * z; square <= 1 && square > 0) return {x, y, z};
  }
}

Vec3 along_plane(const Triangle& t, Random& random) {
  const Vec3 e1 = way(t.a, t.b), e2 = way(t.a, t.c);
  const double x = random.unit(), y = random.unit();
  const Vec3 along = sum(scaled(e1, x), scaled(e2, y));
  return sum(along, scaled(in_ball(random), 0x1p-10 * largest(along)));
}

Vec3 draw_direction(Leaving kind, const Shot& shot, Precision precision, Random& random) {
  for (;;) {
    const Vec3 drawn = kind == Leaving::steep ? in_ball(random) : along_plane(shot.triangle, random);
    if (largest(drawn) == 0) continue;
    const int exponent = std::ilogb(largest(shot.ray.direction)) - std::ilogb(largest(drawn));
    const Vec3 direction = at_precision(scaled(drawn, std::ldexp(1.0, exponent)), precision);
    if (classify(shot.triangle, Ray{shot.ray.origin, direction}).det_sign != 0) return direction;
  }
}

void check(const SelfHitPlan& plan) {
  if (plan.tracers.empty()) throw InputError("no tracer to measure; name one or more, or 'all'");
  if (plan.families.empty()) throw InputError("no family to measure on; name one or more");
  if (plan.rays == 0) throw InputError("no ray to measure with; give a count of 1 or more");
  for (const Tracer* tracer : plan.tracers)
    if (std::ranges::count(plan.tracers, tracer) > 1)
      throw InputError(fmt::format("tracer '{}' is named twice; name it once", tracer->info().name));
}

// A cell while it is measured.
struct Measuring {
  struct Needs {
    Values tracer, exact, excess;
  };
  SelfHitCell cell;
  std::array<Needs, remedy_names.size()> needs;

  void add(const Departure& d) {
    ++cell.rays;
    cell.beyond += d.truth == Return::beyond;
    cell.start += d.truth == Return::start;
    cell.beyond_hits += d.hit && d.truth == Return::beyond;
    cell.start_hits += d.hit && d.truth == Return::start;
    cell.false_hits += d.hit && d.truth == Return::none;
    for (std::size_t r = 0; r < needs.size(); ++r) {
      const auto& [tracer, exact] = d.need[r];
      needs[r].tracer.add(tracer), needs[r].exact.add(exact), needs[r].excess.add(tracer - exact);
      cell.need[r].nothing += tracer == 0;
      cell.need[r].never += std::isinf(tracer);
    }
  }

  SelfHitCell finish() {
    for (std::size_t r = 0; r < needs.size(); ++r) {
      NeedSpread& n = cell.need[r];
      n.tracer = needs[r].tracer.spread(), n.exact = needs[r].exact.spread(), n.excess = needs[r].excess.spread();
    }
    return cell;
  }
};

class Run {
 public:
  Run(const SelfHitPlan& plan, const std::atomic<bool>& stop, const SelfHitProgress& progress)
      : stop_(stop), progress_(progress) {
    result_.plan = plan;
    result_.scores.assign(plan.tracers.size(), std::vector<SelfHitScore>(plan.families.size()));
    result_.conduct.resize(plan.tracers.size());
  }

  SelfHitResult run() {
    {
      std::vector<std::future<void>> workers;  // not jthread: libc++ has none
      for (unsigned i = 0; i < std::max(1u, result_.plan.jobs); ++i)
        workers.push_back(std::async(std::launch::async, [this] { work(); }));
    }
    if (failed_) std::rethrow_exception(failed_);
    return std::move(result_);
  }

 private:
  std::size_t planned() const { return result_.plan.tracers.size() * result_.plan.families.size(); }

  void work() {
    try {
      for (std::size_t next; !stop_ && (next = next_++) < planned();) {
        const std::size_t families = result_.plan.families.size();
        measure(next / families, next % families);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failed_ = std::current_exception();
      next_ = planned();
    }
  }

  void measure(std::size_t tracer, std::size_t family) {
    const SelfHitPlan& plan = result_.plan;
    const SelfHitFamily& f = plan.families[family];
    const Precision precision = plan.tracers[tracer]->info().contract.precision;
    SelfHitScore score;
    std::array<std::array<Measuring, leaving_names.size()>, hit_point_names.size()> cells;
    Conduct conduct;
    std::uint64_t shots = 0;
    for (std::uint64_t index = 0; shots < plan.rays; ++index) {
      if (stop_) return;
      const Shot shot = draw(f.dial, f.setting, precision, plan.seed, index);
      if (!crosses(classify(shot.triangle, shot.ray))) continue;
      ++shots;
      conduct += leave(*plan.tracers[tracer], shot, leaving_rays(shot, precision, plan.seed, index), score, cells);
    }
    for (std::size_t p = 0; p < cells.size(); ++p)
      for (std::size_t l = 0; l < leaving_names.size(); ++l) score.cells[p][l] = cells[p][l].finish();
    const std::lock_guard lock(mutex_);
    result_.scores[tracer][family] = score;
    result_.conduct[tracer] += conduct;
    ++result_.done;
    if (progress_) progress_(result_.done, planned());
  }

  template <class Cells>
  static Conduct leave(const Tracer& tracer, const Shot& shot, const std::vector<LeavingRay>& leaving,
                       SelfHitScore& score, Cells& cells) {
    std::vector<Vec3> directions;
    for (const LeavingRay& ray : leaving) directions.push_back(ray.direction);
    Bag bag;
    bag.triangles = {shot.triangle};
    const auto prepared = tracer.prepare(bag);
    const Departures departures = depart(tracer, *prepared, shot.triangle, shot.ray, directions);
    score.hits += departures.arrival == Outcome::hit;
    score.misses += departures.arrival == Outcome::miss;
    score.faults += departures.arrival == Outcome::fault;
    score.not_finite += !departures.finite;
    for (std::size_t i = 0; i < departures.list.size(); ++i) {
      const Departure& d = departures.list[i];
      const Leaving kind = leaving[i % leaving.size()].kind;
      cells[static_cast<std::size_t>(d.point)][static_cast<std::size_t>(kind)].add(d);
    }
    return prepared->conduct();
  }

  SelfHitResult result_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr failed_;
  const std::atomic<bool>& stop_;
  const SelfHitProgress& progress_;
};

}  // namespace

std::vector<LeavingRay> leaving_rays(const Shot& shot, Precision precision, std::uint64_t seed, std::uint64_t index) {
  Random random(Random(seed, 0).bits(), index);  // hashed: not the numbers that the shot is made of, some apart
  std::vector<LeavingRay> rays;
  for (const Leaving kind : {Leaving::steep, Leaving::grazing}) {
    const Vec3 direction = draw_direction(kind, shot, precision, random);
    rays.push_back({direction, kind});
    rays.push_back({scaled(direction, -1), kind});
  }
  return rays;
}

SelfHitResult measure_self_hits(const SelfHitPlan& plan, const std::atomic<bool>& stop,
                                const SelfHitProgress& progress) {
  check(plan);
  return Run(plan, stop, progress).run();
}

}  // namespace plumbline
