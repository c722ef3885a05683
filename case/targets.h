// The targets of one triangle and the rays aimed at them: ARL-CR-0761, equations 1 to 4, in the operation order that
// reproduces its table (binary64, each operation rounded once, sums left to right).
//
// Order of the rays, with D_PQ the midpoint (P + Q) / 2:
//   4 interior       centroid (A + B + C) / 3; the middles of the medians from A, B, C
//   6 vertex_edge    A, B, C; D_AB, D_BC, D_CA
//   18 for each tolerance n:
//     6 on the edges, at n from a vertex: A->B, A->C, B->A, B->C, C->A, C->B       wish: hit
//     6 on the edge lines, at n beyond the vertex, the same six                    wish: miss
//     3 at n inside an edge's midpoint, along the median: D_BC->A, D_CA->B, D_AB->C  wish: hit
//     3 at n outside of it, the same three                                         wish: miss
// The point at n from P towards Q, with L = |PQ| and m = L - n, is (m P + n Q) / (m + n); beyond P it is
// (m P - n Q) / (m - n) with m = L + n.
//
// A ray's direction is the triangle's normal, its origin the target - standoff * direction. The wish is what the author
// of the target meant; rounding may have moved the ray elsewhere, and a tolerance longer than an edge does.
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "case/case.h"

namespace plumbline {

/// How AB x AC becomes the direction.
enum class Normal : unsigned char {
  divide,      ///< each component divided by the length, as the report does
  reciprocal,  ///< each component times 1 / length
  none,  ///< not normalised. The standoff then counts in lengths of AB x AC; on a lattice of dyadic numbers with a
         ///< dyadic standoff every vertex and midpoint ray is then exact: it meets its target.
};
inline constexpr std::array<std::string_view, 3> normal_names = {"divide", "reciprocal", "none"};
constexpr std::string_view name(Normal n) { return normal_names[static_cast<unsigned>(n)]; }

struct Aiming {
  std::vector<double> tolerances = {0.1, 0.001, 0.00001};  ///< in units of length
  double standoff = 5;                                     ///< in lengths of the direction
  Normal normal = Normal::divide;
};

/// Throws InputError, naming the option and the fix, unless the standoff and every tolerance are positive and finite.
void check(const Aiming& aiming);

/// The same for every triangle: aims(...)[i] belongs to the i-th ray.
std::vector<Aim> aims(const Aiming& aiming);

/// rays.size() == aims(aiming).size(). Doesn't allocate. The rays of a triangle without area have directions that are
/// NaN or zero.
void aim_rays(const Triangle& triangle, const Aiming& aiming, std::span<Ray> rays);

}  // namespace plumbline
