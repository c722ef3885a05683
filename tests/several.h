// Bags of several triangles that a tracer gets wrong, for tests of what becomes of such findings.
#pragma once
#include <string>

#include "case/case_text.h"

namespace plumbline {

/// Crosses both triangles of a folded pair beside the edge that they share: in triangle 1 by 3.77e-16 of its height.
/// moller_trumbore_f64 misses both.
inline const std::string leaking_pair =
    "case pair\n"
    "triangle -0.5 0.25 -0.5  -0.25 0.75 -1.5  0 -1.5 1.5\n"
    "triangle -0.25 0.75 -1.5  -0.5 0.25 -0.5  -1.5 0.5 -0.25\n"
    "ray 2 0.5 -3.5  -0x1.35873d0340b42p+1 -0x1.61cf40d02d088p-4 0x1.561cf40d02d08p+1\n";

/// Behind the pair, and well hit.
inline const std::string behind_the_pair = "triangle -9 -5 2  3 -5 2  -3 9 2\n";

inline Case case_of(const std::string& text) { return parse_cases(text, "a test").front(); }

}  // namespace plumbline
