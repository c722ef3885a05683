// What the programs in C and C++ have in common: the numbers of the case, and the check of what a function `ask`
// says. The text is C and C++ alike. Private to repros/.
#pragma once
#include <string>

#include "repros/evidence.h"

namespace plumbline {

/// Which numbers the library tells of a hit.
struct Told {
  bool t = false, uv = false;
};

/// Declares a, b, c; origin, direction, as arrays; t_min, t_max. `type`: "const float".
std::string c_triangle(const Evidence& evidence, std::string_view type);
std::string c_ray(const Evidence& evidence, std::string_view type);
std::string c_range(const Evidence& evidence, std::string_view type);

/// Declares `Answer` and main, which calls `Answer ask(void)`: exit code 0 if the answer is right, else 1. The
/// includes are math.h, stdbool.h and stdio.h.
std::string c_answer();
std::string c_main(const Evidence& evidence, Told told);

}  // namespace plumbline
