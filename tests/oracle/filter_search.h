// Hill climbing for the worst rounding errors of the filter, with its exact values in binary128: coordinates differ by
// few binades, so that differences are exact there and determinants have 2^-110 of relative error.
#pragma once
#include <array>
#include <string_view>

#include "tests/oracle/float_environment.h"
#include "tests/oracle/grid_shots.h"

namespace plumbline {

/// A determinant of the filter, and the bound it is measured by. V_alone: V by the bound of T, as if that of det had no
/// part.
enum class Measured : unsigned char { det, T, w_ab, w_bc, w_ca, V, V_alone };
inline constexpr std::array<std::string_view, 7> measured_names = {"det", "T", "w_ab", "w_bc", "w_ca", "V", "V_alone"};

enum class Objective : unsigned char {
  error,       ///< |computed - exact| / bound
  wrong_side,  ///< |computed| / bound where exact is zero or has the other sign, and all that the decision needs
               ///< besides is certain
};

/// In the given rounding mode; for wrong_side negative where computed has the right sign.
double ratio(const Shot& shot, Measured measured, Objective objective, const FloatEnvironment& environment);

struct Worst {
  double ratio = 0;
  Shot shot;
};
Worst climb(Measured measured, Objective objective, const FloatEnvironment& environment, Random& random,
            int evaluations);

}  // namespace plumbline
