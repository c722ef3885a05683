// The seed of the random tests.
#pragma once
#include <cstdint>
#include <cstdlib>

namespace plumbline::judges {

/// PLUMBLINE_SEED, or the default; to be printed, so that a failure can be repeated.
inline std::uint64_t seed() {
  const char* text = std::getenv("PLUMBLINE_SEED");
  return text != nullptr ? std::strtoull(text, nullptr, 0) : 20260101;
}

}  // namespace plumbline::judges
