#include "float_tracer/complaints.h"

#include <fmt/format.h>

#include <cstdio>

namespace plumbline {

void Complaints::add(std::string_view what) {
  const std::lock_guard lock(mutex_);
  if (++count_ <= told_at_most) fmt::print(stderr, "warning: {}: {}\n", tracer_, what);
}

void Complaints::insist(std::string_view what) {
  const std::lock_guard lock(mutex_);
  fmt::print(stderr, "warning: {}: {}\n", tracer_, what);
}

Complaints::~Complaints() {
  if (count_ > told_at_most)
    std::fprintf(stderr, "warning: %s: %zu more of these\n", tracer_.c_str(), count_ - told_at_most);
}

}  // namespace plumbline
