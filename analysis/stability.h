// Numerical stability of tracers on the dialled families: error over difficulty, split into what the problem does and
// what the algorithm does.
//
// The error of an answer (forward) is, in ulps of the largest coordinate at the tracer's precision: of a wrong one its
// severity; of a right hit how far its t, u and v are off as lengths (the greater of HitErrors::point and residual); of
// a right miss 0. Its backward error is the least relative change of the coordinates that would make it right, to first
// order, in units of the precision's unit roundoff: error of t, u, v over their sensitivity (oracle/sensitivity.h); of
// a wrong decision, that of the t, u, v or w that it is wrong by. A stable algorithm has a small backward error however
// hard the case.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "analysis/spread.h"
#include "case/dials.h"
#include "float_tracer/tracer.h"

namespace plumbline {

/// A tracer on inputs of a precision: those of binary64 are put binary32 inputs as well, on which they look perfect.
struct Subject {
  const Tracer* tracer = nullptr;
  Precision inputs = Precision::binary64;
};

struct StabilityPlan {
  std::vector<Subject> subjects;
  std::vector<Dial> dials;
  std::uint64_t cases = 1000;  ///< at each setting
  std::uint64_t seed = 1;
  unsigned jobs = 1;  ///< threads; the result doesn't depend on them
};

/// Each tracer on inputs of its own precision, then those of binary64 on binary32 inputs.
std::vector<Subject> subjects_of(const std::vector<const Tracer*>& tracers);

/// One tracer at one setting of a dial.
struct StabilityCell {
  std::uint64_t cases = 0;
  std::uint64_t hits = 0;  ///< right answer a hit; of the rest a miss, but for what is unspecified
  std::uint64_t false_misses = 0, false_hits = 0, unspecified = 0, faults = 0;
  std::uint64_t not_finite = 0;   ///< right hits with a t, u or v that is NaN or infinite
  Spread severity;                ///< ulps, of wrong answers
  Spread nominal_severity;        ///< of those whose case is nominal
  Spread t, u, v;                 ///< ulps of the exact value, of right hits
  Spread point, residual, start;  ///< HitErrors, of right hits
  Spread forward, backward;       ///< of all that are right or wrong
  Spread condition;  ///< sensitivity of t over t, of right hits: by what the problem may enlarge a relative error
};

/// What leaves the right answer as it is: whether the tracer's changes with it.
enum class Symmetry : unsigned char { scale, axes, vertices, translation, direction };
inline constexpr std::array<std::string_view, 5> symmetry_names = {"scale", "axes", "vertices", "translation",
                                                                   "direction"};
constexpr std::string_view name(Symmetry s) { return symmetry_names[static_cast<unsigned>(s)]; }

struct SymmetryCount {
  std::uint64_t asked = 0, changed = 0;  ///< hit to miss or back
};

/// Of two builds of one tracer: answers that differ in being a hit.
struct BuildCount {
  std::size_t base = 0, variant = 0;  ///< subjects of the plan
  std::uint64_t asked = 0, differ = 0;
};

/// Bin b holds the right hits with 2^b <= condition < 2^(b+1), of all dials; the first and last what is beyond.
inline constexpr int condition_bins = 64;

struct StabilityResult {
  StabilityPlan plan;
  std::vector<std::vector<std::vector<StabilityCell>>> cells;                ///< by subject, dial, setting
  std::vector<std::array<SymmetryCount, symmetry_names.size()>> symmetries;  ///< by subject
  std::vector<BuildCount> builds;
  /// By subject: relative error of t, in units of the unit roundoff.
  std::vector<std::array<Spread, condition_bins>> conditions;
  std::vector<Conduct> conduct;  ///< by subject
};

/// The tracer's backward error up to `setting` stays within `bound`; and how fast its error grows.
struct StabilityVerdict {
  bool stable = true;
  int leaves_at = 0;  ///< the first setting whose 99th percentile of the backward error is above the bound
  double slope = 0;   ///< of log2 of the 99th percentile of the forward error over the setting, least squares
};

/// A backward error of so many unit roundoffs is called stable: three dozen operations, each rounding once.
inline constexpr double stable_bound = 64;

StabilityVerdict verdict(const std::vector<int>& settings, const std::vector<StabilityCell>& cells);

using StabilityProgress = std::function<void(std::uint64_t done, std::uint64_t planned)>;

/// Throws InputError where there is nothing to do. When `stop` becomes true, throws std::runtime_error.
StabilityResult measure_stability(const StabilityPlan& plan, const std::atomic<bool>& stop = false,
                                  const StabilityProgress& progress = {});

}  // namespace plumbline
