// Many rays at a mesh, through many tracers, each answer judged by the exact nearest hit.
//
// A tracer that finds its way among many triangles (TracerInfo::has_tree) is asked about the whole mesh. One that looks
// at each triangle in turn is asked so up to whole_limit triangles; beyond, about those whose boxes the ray meets: then
// what it would hit elsewhere, where nothing is near, is not seen.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/bag_examine.h"
#include "float_tracer/conduct.h"
#include "float_tracer/tracer.h"
#include "mesh/mesh.h"

namespace plumbline {

/// Rays of one kind: 0 to size - 1.
struct ScanSet {
  std::string name;
  std::uint64_t size = 0;
  std::function<Ray(std::uint64_t)> ray;  ///< a function of the index alone; called by several threads
};

inline constexpr std::size_t whole_limit = 1024;

/// What a tracer answered to a set. Numbers that add, so that the result is the same for any number of threads.
struct ScanTally {
  std::array<std::uint64_t, bag_verdict_names.size()> verdicts{};
  std::array<std::uint64_t, 3> leaks{};  ///< those of a point inside of a triangle; else on an edge; else at a vertex
  std::uint64_t through = 0;             ///< wrong nearest hits of triangles that lie behind, on the ray: leaks as well
  std::uint64_t culled = 0;              ///< leaks and wrong nearest hits that were lost in boxes or traversal
  double worst_ulps = 0;                 ///< the greatest severity
  std::uint64_t operator[](BagVerdict v) const { return verdicts[static_cast<std::size_t>(v)]; }
  friend bool operator==(const ScanTally&, const ScanTally&) = default;
};
ScanTally& operator+=(ScanTally& sum, const ScanTally& more);

/// What is true of a set, in binary32 or binary64 as the mesh is.
struct ScanTruth {
  std::array<std::uint64_t, 4> nearest{};  ///< inside of a triangle, on an edge, at a vertex; nothing is hit
  friend bool operator==(const ScanTruth&, const ScanTruth&) = default;
};
ScanTruth& operator+=(ScanTruth& sum, const ScanTruth& more);

/// Seconds of processor time, by and large: they aren't the same in two runs.
struct ScanTimes {
  double exact = 0;             ///< the nearest hits of the mesh's own rays, with their owners
  std::vector<double> tracers;  ///< to trace the same rays, building not counted
};

struct ScanFinding {
  const Tracer* tracer = nullptr;
  BagSignature signature;
  BagJudgement judgement;
  const ScanSet* set = nullptr;
  std::uint64_t index = 0;  ///< of the ray
  /// The ray and, of the whole mesh, the triangles that are wanted to see it again: those whose boxes it meets, and
  /// more around where that isn't enough (a tree loses its way among many). Where 4096 aren't either, the first ones.
  Case what;
  bool reproduced = false;               ///< the tracer gets `what` wrong in the same way
  std::vector<std::uint32_t> triangles;  ///< those of what.bag, as indices of the mesh's
};

struct ScanPlan {
  const Mesh* mesh = nullptr;
  std::vector<ScanSet> sets;
  std::vector<const Tracer*> tracers;
  unsigned jobs = 1;
  /// Of each tracer and signature the first and each that is twice as severe; called by one thread at a time.
  std::function<void(const ScanFinding&)> on_finding = {};
  /// What was told before, by tracer and the word of the signature: its severity in ulps.
  std::map<std::pair<std::string, std::string>, double> told = {};
};

/// How far a scan is: the blocks of rays done, without a gap. Can be kept, and taken up.
struct ScanState {
  std::uint64_t blocks = 0;
  std::vector<ScanTruth> truths;                // by set
  std::vector<std::vector<ScanTally>> tallies;  // by set and tracer
  friend bool operator==(const ScanState&, const ScanState&) = default;
};

/// Of nothing done.
ScanState blank(const ScanPlan& plan);

/// One line, words and numbers.
std::string to_line(const ScanState& state);
/// No value where that isn't a line of such a plan.
std::optional<ScanState> from_line(const std::string& line, const ScanPlan& plan);

struct ScanResult {
  ScanState state;
  ScanTimes times;               ///< of this run
  std::uint64_t rays = 0;        ///< of this run
  std::vector<Conduct> conduct;  ///< of each tracer
  std::size_t bytes = 0;         ///< of the mesh and the tree of the oracle
  bool complete = false;
};

struct ScanProgress {
  std::uint64_t rays = 0, all = 0;
  const ScanState* state = nullptr;
};

/// From `begin`, which is blank or was kept of the same plan, until all is done or `stop` becomes true. The state in
/// the result depends on the plan without jobs alone.
ScanResult scan(const ScanPlan& plan, ScanState begin, const std::atomic<bool>& stop,
                const std::function<void(const ScanProgress&)>& progress);

}  // namespace plumbline
