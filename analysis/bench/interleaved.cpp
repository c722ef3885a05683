#include "analysis/bench/interleaved.h"

#include <algorithm>
#include <ctime>

namespace plumbline {
namespace {

double seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_of(const Timed& method, std::size_t times) {
  const clockid_t clock = method.elsewhere ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID;
  const double begin = seconds(clock);
  for (std::size_t i = 0; i < times; ++i) method.pass();
  return seconds(clock) - begin;
}

// Warms up as well.
std::size_t passes_for(const Timed& method, double slice_seconds) {
  std::size_t passes = 1;
  while (seconds_of(method, passes) < slice_seconds) passes *= 2;
  return passes;
}

}  // namespace

std::vector<std::vector<double>> interleaved_ns(const std::vector<Timed>& methods, std::size_t rounds,
                                                double slice_seconds) {
  std::vector<std::size_t> passes;
  for (const Timed& method : methods) passes.push_back(passes_for(method, slice_seconds));
  std::vector<std::vector<double>> ns(methods.size());
  for (std::size_t round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < methods.size(); ++k)
      ns[k].push_back(1e9 * seconds_of(methods[k], passes[k]) / static_cast<double>(passes[k] * methods[k].cases));
  return ns;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace plumbline
