// Times several ways of doing the same thing in turns: every round runs each for one slice of time, so that what
// disturbs the machine disturbs all of them, and their ratio is taken within a round. In processor time of the thread,
// which other programs don't add to.
//
// Google Benchmark is not used: its random interleaving draws repetitions from all that is registered and reports them
// without their order, so that no ratio can be taken of neighbours.
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

namespace plumbline {

struct Timed {
  std::function<void()> pass;  ///< does all cases once
  std::size_t cases = 0;
  bool elsewhere = false;  ///< another process does the work: wall-clock time, which other programs do add to
};

/// Nanoseconds per case, [method][round]. A slice is at least one pass.
std::vector<std::vector<double>> interleaved_ns(const std::vector<Timed>& methods, std::size_t rounds,
                                                double slice_seconds);

/// Not of an empty list.
double median(std::vector<double> values);

}  // namespace plumbline
