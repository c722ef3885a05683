// Leaks, double hits and wrong orders, tracer by tracer: bags of triangles whose rays pass through shared edges and
// vertices, or by an ulp beside them, through stacks and overlaps, asked as a whole and one triangle at a time.
//
// Every tracer is judged on what it was really asked; the truth of a ray is found once for all that search the same
// range. Same plan, same result, whatever `jobs`.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "case/bag_families.h"
#include "float_tracer/tracer.h"

namespace plumbline {

/// Which table a test is told in.
enum class LeakTable : unsigned char {
  shared,   ///< edges and vertices that triangles share: pairs, fans, strips
  spheres,  ///< the same, of closed spheres
  layered,  ///< several triangles behind each other or in one plane, a lattice's, and rays all but in a plane
};

/// One column of a table: a family of bags and how it is shot at.
struct LeakTest {
  LeakTable table;
  std::string_view name;
  BagFamily family;
  std::array<BagTarget, 2> targets;  ///< of every other bag
  BagOrigin origin;
  Precision precision;  ///< of all numbers; binary64 is for tracers that read it
  int bits, ulps;       ///< as in BagAim
};

/// Of either precision the same. From lattice_bags times four rays on (421,200), all bags of the lattice are there;
/// from twice as many, each is shot at its edge and at a vertex.
std::span<const LeakTest> leak_tests();

struct LeakPlan {
  std::vector<const Tracer*> tracers;
  std::uint64_t rays = 5000;  ///< of each test
  std::uint64_t seed = 1;
  unsigned jobs = 1;
};

/// Of one kind of error: how often it is there, how often it breaks the tracer's contract, and the worst that does,
/// in ulps.
struct LeakCount {
  std::uint64_t all = 0, broken = 0;
  double worst = 0;
  LeakCount& operator+=(const LeakCount& more);
  friend bool operator==(const LeakCount&, const LeakCount&) = default;
};

/// What `all` counts is told as if the tracer promised closed edges and no slack.
struct LeakScore {
  std::uint64_t rays = 0;
  // Triangles asked one by one: each with the rays that cross it or one that shares a vertex with it, in a small bag
  // with all of them.
  LeakCount leaks = {};      ///< a triangle is crossed and none is hit, or not all of the surfaces that are crossed
  LeakCount doubles = {};    ///< one is hit that isn't crossed, beside those that are
  LeakCount displaced = {};  ///< one is hit that isn't crossed, for one that is
  LeakCount order = {};      ///< of two that are crossed, the farther is hit at a smaller t
  LeakCount parity = {};     ///< of closed bags: an odd number of hits where it should be even, or the other way round
  std::uint64_t apart = 0;   ///< rays not counted above: its interface asked the triangles other lines than the bag
  // The bag as a whole.
  LeakCount bag_leaks = {};          ///< something is crossed and the answer is a miss
  LeakCount nearest = {};            ///< the hit is of a triangle that isn't nearest
  LeakCount false_hits = {};         ///< nothing is there
  std::uint64_t culled_leaks = 0;    ///< of bag_leaks, those lost in boxes and traversal, not by the triangle test
  std::uint64_t culled_nearest = 0;  ///< of nearest, likewise
  std::uint64_t faults = 0;          ///< rays without an answer
  LeakScore& operator+=(const LeakScore& more);
  friend bool operator==(const LeakScore&, const LeakScore&) = default;
};

struct LeakResult {
  LeakPlan plan;
  std::vector<std::vector<LeakScore>> scores;  ///< by tracer, test; no ray where the tracer can't read the test
  std::vector<Conduct> conduct;                ///< of each tracer
  std::uint64_t done = 0, planned = 0;         ///< bags
};

using LeakProgress = std::function<void(std::uint64_t done, std::uint64_t planned)>;

/// Stopped, it finishes the bags under way. Throws InputError where there is nothing to ask.
LeakResult find_leaks(const LeakPlan& plan, const std::atomic<bool>& stop = false, const LeakProgress& progress = {});

}  // namespace plumbline
