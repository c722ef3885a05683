// What it costs to ask a tracer through float_tracer/tracer.h instead of by a loop of one's own, and in a child
// process.
#pragma once
#include <cstddef>
#include <string>

namespace plumbline {

struct InterfacePlan {
  std::size_t rounds = 200;  ///< of which the fastest counts, for each way alone
};

/// Moller and Trumbore's test in binary64, one triangle: nanoseconds per ray, in batches of several sizes, with a bag
/// prepared once, and with one prepared for each batch. Wall-clock times, least of the rounds, and their ratios.
std::string bench_interface(const InterfacePlan& plan);

}  // namespace plumbline
