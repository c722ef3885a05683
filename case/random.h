// Pseudorandom numbers with the same bits on every machine, whatever the compiler: SplitMix64 (Steele, Lea, Flood,
// "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014). The sequence is part of the contract: families and
// campaigns are reproduced from their seed.
#pragma once
#include <cstdint>

namespace plumbline {

class Random {
 public:
  /// Every seed and stream starts a sequence of its own; but those of neighbouring seeds are the same, one number apart,
  /// so hash a seed that a user chooses, unless streams are short.
  Random(std::uint64_t seed, std::uint64_t stream) : state_(seed * 0x9e3779b97f4a7c15u + stream * 0xd1342543de82ef95u) {
    bits();
  }

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// Uniform in [low, high].
  std::int64_t integer(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  /// Uniform in [0, n), n > 0.
  std::uint64_t below(std::uint64_t n) { return bits() % n; }
  /// Uniform in (-1, 1), 53 bits.
  double unit() {
    return static_cast<double>(integer(-(std::int64_t{1} << 53) + 1, (std::int64_t{1} << 53) - 1)) * 0x1p-53;
  }
  bool chance(int one_in) { return bits() % static_cast<unsigned>(one_in) == 0; }

 private:
  std::uint64_t state_;
};

}  // namespace plumbline
