// The seeds of the random tests.
#pragma once
#include <chrono>
#include <cstdint>
#include <cstdlib>

namespace plumbline::judges {

/// PLUMBLINE_SEED, or the default; to be printed, so that a failure can be repeated.
inline std::uint64_t seed() {
  const char* text = std::getenv("PLUMBLINE_SEED");
  return text != nullptr ? std::strtoull(text, nullptr, 0) : 20260101;
}

/// PLUMBLINE_SEED, or the day, so that every night tests other cases; to be printed.
inline std::uint64_t nightly_seed() {
  if (std::getenv("PLUMBLINE_SEED") != nullptr) return seed();
  const auto today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  return static_cast<std::uint64_t>(today.time_since_epoch().count());
}

}  // namespace plumbline::judges
