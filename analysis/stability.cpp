#include "analysis/stability.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <future>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "analysis/ask.h"
#include "case/finite.h"
#include "case/input_error.h"
#include "case/precision.h"
#include "oracle/classify.h"
#include "oracle/hit_errors.h"
#include "oracle/judge.h"
#include "oracle/margins.h"
#include "oracle/sensitivity.h"

namespace plumbline {
namespace {

double unit_roundoff(Precision precision) { return precision == Precision::binary32 ? 0x1p-24 : 0x1p-53; }

// What the oracle says of a query, kept for the next tracer that is asked the same.
struct Facts {
  Query query;
  Precision precision = Precision::binary64;
  Truth truth;
  std::optional<Margins> margins;
  std::optional<Sensitivity> sensitivity;
};

class FactsOfACase {
 public:
  explicit FactsOfACase(const Triangle& triangle) : triangle_(triangle) {}

  const Facts& of(const Query& query, Precision precision) {
    for (const Facts& f : known_)
      if (f.query == query && f.precision == precision) return f;
    return known_.emplace_back(Facts{.query = query,
                                     .precision = precision,
                                     .truth = classify(triangle_, query),
                                     .margins = margins(triangle_, query, precision),
                                     .sensitivity = sensitivity(triangle_, query)});
  }

 private:
  const Triangle& triangle_;
  std::vector<Facts> known_;
};

// By how much a wrong decision is wrong, over what a relative change of all coordinates by 1 moves it by.
double backward_of_decision(const Facts& f, bool answered_hit) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!f.margins || !f.sensitivity) return none;
  const Margins& m = *f.margins;
  const Sensitivity& s = *f.sensitivity;
  // By how much each lies inside; negative outside.
  const Ray& ray = f.query.ray;
  const std::array<std::array<double, 2>, 5> inside = {
      {{m.u, s.u}, {m.v, s.v}, {m.w, s.w}, {m.t - ray.t_min, s.t}, {ray.t_max - m.t, s.t}}};
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const auto& [margin, moved] : inside) {
    const double change = moved > 0 ? std::abs(margin) / moved : 0;
    if (margin < 0) most = std::max(most, change);
    least = std::min(least, change);
  }
  return answered_hit ? most : least;
}

double backward_of_numbers(const HitErrors& e, const Sensitivity& s) {
  double most = 0;
  for (const auto& [off, moved] : {std::array{e.t_off, s.t}, {e.u_off, s.u}, {e.v_off, s.v}})
    if (off > 0) most = std::max(most, off / moved);
  return most;
}

HitNumbers numbers_of(const Answer& answer) {
  HitNumbers said;
  if (answer.has_t) said.t = answer.t;
  if (answer.has_uv) said.uv = {answer.u, answer.v};
  return said;
}

bool finite(const Answer& a) {
  return !(a.has_t && !is_finite(a.t)) && !(a.has_uv && !(is_finite(a.u) && is_finite(a.v)));
}

// The shot as it is after the symmetry, which changes no right answer; no value where rounding would.
std::optional<Shot> changed(const Shot& shot, Symmetry symmetry, Precision precision, std::uint64_t index) {
  Shot s = shot;
  const std::array<Vec3*, 4> points = {&s.triangle.a, &s.triangle.b, &s.triangle.c, &s.ray.origin};
  const auto exact = [precision](double x, double least) {
    return is_finite(x) && at_precision(x, precision) == x && (x == 0 || std::abs(x) >= least);
  };
  // Half of the way to the least normal number: below, an exact change may still lose bits within the tracer.
  const double least = precision == Precision::binary32 ? 0x1p-126 : 0x1p-1022;
  bool same = true;
  const auto scale = [&](Vec3& v, double by) {
    for (double* x : {&v.x, &v.y, &v.z}) same = same && exact(*x *= by, least);
  };
  const auto move = [&](double& x, double by) {
    const double sum = x + by, rest = sum - x;  // without error (Dekker, Knuth: the part that is lost)
    same = same && (x - (sum - rest)) + (by - rest) == 0 && exact(sum, 0);
    x = sum;
  };
  const auto turn = [](Vec3& v) { v = {v.y, v.z, v.x}; };
  const bool odd = index % 2 != 0;
  switch (symmetry) {
    case Symmetry::scale:
      for (Vec3* p : points) scale(*p, odd ? 0x1p+12 : 0x1p-12);
      break;
    case Symmetry::axes:
      for (Vec3* p : points) turn(*p);
      turn(s.ray.direction);
      break;
    case Symmetry::vertices:
      s.triangle = {s.triangle.b, s.triangle.c, s.triangle.a};
      break;
    case Symmetry::translation:
      for (Vec3* p : points) move(p->x, 4), move(p->y, -8), move(p->z, 2);
      break;
    case Symmetry::direction:
      scale(s.ray.direction, odd ? 0x1p+5 : 0x1p-5);
      break;
  }
  return same ? std::optional(s) : std::nullopt;
}

Answer answer_of(const Tracer& tracer, const Shot& shot, Conduct& conduct, Query& asked) {
  Bag bag;
  bag.triangles = {shot.triangle};
  const auto prepared = tracer.prepare(bag);
  Answer answer;
  prepared->trace({&shot.ray, 1}, {&answer, 1});
  asked = prepared->asked(shot.ray);
  conduct += prepared->conduct();
  return answer;
}

// One subject at one setting, while it is measured.
struct Measuring {
  StabilityCell cell;
  Values severity, nominal_severity, t, u, v, point, residual, start, forward, backward, condition;
  std::vector<Outcome> outcomes;
  std::array<SymmetryCount, symmetry_names.size()> symmetries{};
  std::vector<std::pair<int, double>> relative;  // condition bin, relative error of t
  Conduct conduct;

  StabilityCell finish() {
    cell.severity = severity.spread(), cell.nominal_severity = nominal_severity.spread();
    cell.t = t.spread(), cell.u = u.spread(), cell.v = v.spread();
    cell.point = point.spread(), cell.residual = residual.spread(), cell.start = start.spread();
    cell.forward = forward.spread(), cell.backward = backward.spread(), cell.condition = condition.spread();
    return cell;
  }
};

void measure_wrong(Measuring& m, const Facts& f, bool answered_hit, Precision precision) {
  ++(answered_hit ? m.cell.false_hits : m.cell.false_misses);
  const double ulps = f.margins && f.margins->hit != answered_hit ? f.margins->severity_ulps : 0;
  m.severity.add(ulps);
  if (f.margins && f.margins->condition().nominal()) m.nominal_severity.add(ulps);
  m.forward.add(ulps);
  m.backward.add(backward_of_decision(f, answered_hit) / unit_roundoff(precision));
}

void measure_hit(Measuring& m, const Triangle& triangle, const Facts& f, const Answer& answer, Precision precision) {
  m.cell.not_finite += !finite(answer);
  const auto e = hit_errors(triangle, f.query, numbers_of(answer), precision);
  if (!e || !f.sensitivity) return;
  m.t.add(e->t), m.u.add(e->u), m.v.add(e->v);
  m.point.add(e->point), m.residual.add(e->residual), m.start.add(e->start);
  m.forward.add(std::fmax(std::fmax(e->point, e->residual), 0));  // fmax: what isn't told is NaN
  m.backward.add(backward_of_numbers(*e, *f.sensitivity) / unit_roundoff(precision));
  if (!f.margins || f.margins->t == 0) return;
  const double t = std::abs(f.margins->t), condition = f.sensitivity->t / t;
  m.condition.add(condition);
  if (!answer.has_t || !(condition > 0)) return;
  const int bin = std::clamp(std::ilogb(condition), 0, condition_bins - 1);
  m.relative.emplace_back(bin, e->t_off / t / unit_roundoff(precision));
}

void measure_symmetries(Measuring& m, const Tracer& tracer, const Shot& shot, Precision inputs, const Answer& answer,
                        std::uint64_t index) {
  for (std::size_t i = 0; i < symmetry_names.size(); ++i) {
    const auto other = changed(shot, static_cast<Symmetry>(i), inputs, index);
    if (!other) continue;
    Query asked;
    const Answer again = answer_of(tracer, *other, m.conduct, asked);
    if (again.outcome == Outcome::fault) continue;
    ++m.symmetries[i].asked;
    m.symmetries[i].changed += again.outcome != answer.outcome;
  }
}

void measure(Measuring& m, const Subject& subject, const Shot& shot, FactsOfACase& facts, std::uint64_t index) {
  const Contract& contract = subject.tracer->info().contract;
  Query asked;
  const Answer answer = answer_of(*subject.tracer, shot, m.conduct, asked);
  m.outcomes.push_back(answer.outcome);
  ++m.cell.cases;
  const Facts& f = facts.of(searched_ray(asked, contract), contract.precision);
  const VerdictKind verdict = judge(shot.triangle, asked, f.truth, answer, contract);
  const bool said_hit = answer.outcome == Outcome::hit;
  m.cell.unspecified += verdict == VerdictKind::unspecified;
  m.cell.faults += verdict == VerdictKind::fault;
  if (verdict == VerdictKind::unspecified || verdict == VerdictKind::fault) return;
  m.cell.hits += said_hit != wrong(verdict);
  if (wrong(verdict)) {
    measure_wrong(m, f, said_hit, contract.precision);
  } else if (said_hit) {
    measure_hit(m, shot.triangle, f, answer, contract.precision);
  } else {
    m.forward.add(0);
    m.backward.add(0);
  }
  if (index % 4 < 2) measure_symmetries(m, *subject.tracer, shot, subject.inputs, answer, index);
}

// A tracer's name, or the longest that another's begins with: the same algorithm, built in another way.
std::optional<std::size_t> base_of(const std::vector<Subject>& subjects, std::size_t variant) {
  const std::string& name = subjects[variant].tracer->info().name;
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    const std::string& shorter = subjects[i].tracer->info().name;
    if (i == variant || subjects[i].inputs != subjects[variant].inputs || !name.starts_with(shorter + "_")) continue;
    if (!best || shorter.size() > subjects[*best].tracer->info().name.size()) best = i;
  }
  return best;
}

class Run {
 public:
  Run(const StabilityPlan& plan, const std::atomic<bool>& stop, const StabilityProgress& progress)
      : stop_(stop), progress_(progress) {
    result_.plan = plan;
    const std::size_t subjects = plan.subjects.size();
    result_.cells.resize(subjects);
    result_.symmetries.resize(subjects);
    result_.conditions.resize(subjects);
    result_.conduct.resize(subjects);
    relative_.resize(subjects);
    for (std::size_t s = 0; s < subjects; ++s) {
      for (const Dial dial : plan.dials) result_.cells[s].emplace_back(settings(dial, plan.subjects[s].inputs).size());
      if (const auto base = base_of(plan.subjects, s)) result_.builds.push_back({.base = *base, .variant = s});
    }
    for (const Precision inputs : {Precision::binary32, Precision::binary64}) {
      if (std::ranges::none_of(plan.subjects, [&](const Subject& s) { return s.inputs == inputs; })) continue;
      for (std::size_t dial = 0; dial < plan.dials.size(); ++dial)
        for (std::size_t i = 0; i < settings(plan.dials[dial], inputs).size(); ++i) tasks_.push_back({inputs, dial, i});
    }
  }

  StabilityResult run() {
    {
      std::vector<std::future<void>> workers;  // not jthread: libc++ has none
      for (unsigned i = 0; i < std::max(1u, result_.plan.jobs); ++i)
        workers.push_back(std::async(std::launch::async, [this] { work(); }));
    }
    if (failed_) std::rethrow_exception(failed_);
    if (stop_) throw std::runtime_error("interrupted: nothing was written; run it again, --quick is faster");
    for (std::size_t s = 0; s < relative_.size(); ++s)
      for (std::size_t bin = 0; bin < condition_bins; ++bin) result_.conditions[s][bin] = relative_[s][bin].spread();
    return std::move(result_);
  }

 private:
  struct Task {
    Precision inputs;
    std::size_t dial, setting;
  };

  void work() {
    try {
      for (std::size_t next; !stop_ && (next = next_++) < tasks_.size();) {
        measure_setting(tasks_[next]);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failed_ = std::current_exception();
      next_ = tasks_.size();
    }
  }

  void measure_setting(const Task& task) {
    const StabilityPlan& plan = result_.plan;
    const Dial dial = plan.dials[task.dial];
    const int setting = settings(dial, task.inputs)[task.setting];
    std::vector<std::size_t> who;
    for (std::size_t s = 0; s < plan.subjects.size(); ++s)
      if (plan.subjects[s].inputs == task.inputs) who.push_back(s);
    std::vector<Measuring> all(who.size());
    for (std::uint64_t index = 0; index < plan.cases && !stop_; ++index) {
      const Shot shot = draw(dial, setting, task.inputs, plan.seed, index);
      FactsOfACase facts(shot.triangle);
      for (std::size_t i = 0; i < who.size(); ++i) measure(all[i], plan.subjects[who[i]], shot, facts, index);
    }
    std::vector<StabilityCell> cells;
    for (Measuring& m : all) cells.push_back(m.finish());
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < who.size(); ++i) take(who[i], task, all[i], cells[i]);
    compare_builds(who, all);
    if (progress_) progress_(++done_, tasks_.size());
  }

  void take(std::size_t subject, const Task& task, Measuring& m, const StabilityCell& cell) {
    result_.cells[subject][task.dial][task.setting] = cell;
    for (std::size_t i = 0; i < m.symmetries.size(); ++i) {
      result_.symmetries[subject][i].asked += m.symmetries[i].asked;
      result_.symmetries[subject][i].changed += m.symmetries[i].changed;
    }
    for (const auto& [bin, error] : m.relative) relative_[subject][static_cast<std::size_t>(bin)].add(error);
    result_.conduct[subject] += m.conduct;
  }

  void compare_builds(const std::vector<std::size_t>& who, const std::vector<Measuring>& all) {
    const auto at = [&](std::size_t subject) {
      return static_cast<std::size_t>(std::ranges::find(who, subject) - who.begin());
    };
    for (BuildCount& b : result_.builds) {
      const std::size_t base = at(b.base), variant = at(b.variant);
      if (base == who.size() || variant == who.size()) continue;
      for (std::size_t i = 0; i < all[base].outcomes.size(); ++i) {
        const Outcome x = all[base].outcomes[i], y = all[variant].outcomes[i];
        if (x == Outcome::fault || y == Outcome::fault) continue;
        ++b.asked;
        b.differ += x != y;
      }
    }
  }

  StabilityResult result_;
  std::vector<std::array<Values, condition_bins>> relative_;
  std::vector<Task> tasks_;
  std::atomic<std::size_t> next_ = 0;
  std::uint64_t done_ = 0;
  std::mutex mutex_;
  std::exception_ptr failed_;
  const std::atomic<bool>& stop_;
  const StabilityProgress& progress_;
};

}  // namespace

std::vector<Subject> subjects_of(const std::vector<const Tracer*>& tracers) {
  std::vector<Subject> list;
  for (const Tracer* tracer : tracers) list.push_back({tracer, tracer->info().contract.precision});
  for (const Tracer* tracer : tracers)
    if (tracer->info().contract.precision == Precision::binary64) list.push_back({tracer, Precision::binary32});
  return list;
}

StabilityVerdict verdict(const std::vector<int>& settings, const std::vector<StabilityCell>& cells) {
  StabilityVerdict v;
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (v.stable && cells[i].backward.p99 > stable_bound) v.stable = false, v.leaves_at = settings[i];
    const double error = cells[i].forward.p99;
    if (!(error > 0) || !is_finite(error)) continue;
    const double k = settings[i], log = std::log2(error);
    ++n, x += k, y += log, xx += k * k, xy += k * log;
  }
  const double spread = n * xx - x * x;
  if (spread > 0) v.slope = (n * xy - x * y) / spread;
  return v;
}

StabilityResult measure_stability(const StabilityPlan& plan, const std::atomic<bool>& stop,
                                  const StabilityProgress& progress) {
  if (plan.subjects.empty()) throw InputError("no tracer to measure; name one or more, or 'all'");
  if (plan.dials.empty()) throw InputError("no family to measure on; name one or more");
  if (plan.cases == 0) throw InputError("no case to measure on; give a count of 1 or more");
  return Run(plan, stop, progress).run();
}

}  // namespace plumbline
