// The report's experiment: every tracer against every target of every triangle of a lattice, judged by the oracle.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "analysis/tally.h"
#include "case/case.h"
#include "case/lattice.h"
#include "case/query.h"
#include "case/targets.h"
#include "float_tracer/tracer.h"

namespace plumbline {

struct WrongAnswer {
  const Tracer& tracer;
  Case what;  ///< as put to the tracer
  Query asked;
  Answer answer;
};

struct SweepPlan {
  std::vector<Lattice> lattices;        ///< at least one; of the same box and step, at different offsets
  std::vector<double> standoffs = {5};  ///< in lengths of the direction
  std::vector<double> tolerances = {0.1, 0.001, 0.00001};
  Normal normal = Normal::divide;
  Bag object;  ///< mode, thickness and so on of each triangle; no triangles
  std::vector<const Tracer*> tracers;
  TripleRange triples;  ///< of each lattice
  /// Called for each wrong answer, by several threads at once; none: nobody wants to know.
  std::function<void(const WrongAnswer&)> on_wrong = {};
  unsigned jobs = 1;    ///< threads
};

/// One line of the table: a tracer at one place and standoff, on one kind of target.
struct SweepRow {
  const Tracer* tracer = nullptr;
  Vec3 offset;  ///< of the lattice: its first point
  double standoff = 0;
  TargetKind target = TargetKind::interior;
  std::optional<double> tolerance;
  Tally tally;
};

struct SweepResult {
  std::vector<SweepRow> rows;   ///< by tracer, lattice, standoff, then interior, vertex_edge, each tolerance
  TripleRange done;             ///< shorter than planned on interruption; the sweep can then be taken up at its end
  std::vector<Conduct> conduct;  ///< of each tracer of the plan
  std::uint64_t triangles = 0;  ///< those of the triples done that are not collinear
};

/// Called with the number of triples done and planned, by one thread at a time.
using SweepProgress = std::function<void(std::uint64_t done, std::uint64_t planned)>;

/// Throws InputError where the plan makes no sense: a distance that is not positive, or anything given twice.
void check(const SweepPlan& plan);

/// Of a plan that passes the check. The result depends on the plan without `jobs` only, unless `stop` becomes true:
/// then the batches under way are finished, and the result covers the triples before them without a gap.
SweepResult sweep(const SweepPlan& plan, const std::atomic<bool>& stop = false, const SweepProgress& progress = {});

}  // namespace plumbline
