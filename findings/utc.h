// A time as findings tell it: UTC, 2026-11-26T01:30:00Z.
#pragma once
#include <fmt/chrono.h>

#include <chrono>
#include <string>

namespace plumbline {

inline std::string utc_text(std::chrono::system_clock::time_point at) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(at)));
}

}  // namespace plumbline
