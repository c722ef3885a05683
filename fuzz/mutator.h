// Changes an input a little, as geometry suggests: steps of ulps, exponents, copied coordinates, rays put on edges and
// vertices, needles and caps, grazing rays, far offsets, grids; and one coordinate solved for exactly, so that the ray
// lies on a decision boundary, or some ulps beside it. The same Random gives the same changes on every machine.
#pragma once
#include <vector>

#include "case/case_bytes.h"
#include "case/random.h"

namespace plumbline {

struct MutatorPlan {
  Space space = Space::ray;
  Precision precision = Precision::binary64;
  Domain domain = Domain::nominal;
  std::vector<double> constants;  ///< the tracer's own: tolerances, standoffs and sizes are put at these, some ulps beside
};

class Mutator {
 public:
  explicit Mutator(MutatorPlan plan) : plan_(std::move(plan)) {}

  /// The triangle (0,0,0), (1,0,0), (0,1,0), and a ray that goes squarely through it.
  FuzzInput seed() const;
  /// Coordinates of about [-4, 4].
  FuzzInput fresh(Random& random) const;
  /// One to four changes. What comes out is in the domain, its direction not zero.
  FuzzInput changed(const FuzzInput& parent, Random& random) const;

 private:
  MutatorPlan plan_;
};

}  // namespace plumbline
