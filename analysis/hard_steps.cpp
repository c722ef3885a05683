#include "analysis/hard_steps.h"

#include <array>
#include <cmath>

#include "analysis/simpler_number.h"

namespace plumbline {

double plain_number(int digits, Random& random) {
  constexpr std::array<double, 10> plain = {0, 0, 1, -1, 2, -2, 0.5, 4, 3, -3};
  const auto i = random.below(plain.size() + 2);
  if (i < plain.size()) return plain[i];
  const double power = std::ldexp(1.0, static_cast<int>(random.integer(-digits, 8)));
  return random.chance(2) ? power : -power;
}

void simplify_hard(std::span<double* const> coordinates, int digits, Random& random) {
  const auto mask = random.bits();
  const int bits = 1 + static_cast<int>(random.below(random.chance(2) ? 4 : 12));
  switch (random.below(4)) {
    case 0:
      for (std::size_t i = 0; i < coordinates.size(); ++i)
        if ((mask >> i & 1) != 0) *coordinates[i] = rounded_to_bits(*coordinates[i], bits, 0);
      return;
    case 1:
      for (double* x : coordinates.subspan(3 * random.below(coordinates.size() / 3), 3))
        *x = static_cast<double>(random.integer(-bits, bits));
      return;
    case 2:
      for (auto k = 1 + random.below(3); k > 0; --k)
        *coordinates[random.below(coordinates.size())] = plain_number(digits, random);
      return;
    default: {
      const double grid = std::ldexp(1.0, 2 - static_cast<int>(random.below(12)));
      const bool all = !random.chance(4);
      for (std::size_t i = 0; i < coordinates.size(); ++i)
        if (all || (mask >> i & 1) != 0) *coordinates[i] = grid * std::nearbyint(*coordinates[i] / grid);
    }
  }
}

}  // namespace plumbline
