// What a tracer says of one ray.
#pragma once
#include <cstdint>

namespace plumbline {

enum class Outcome : unsigned char {
  miss,
  hit,
  fault,  ///< no answer: the input is outside the tracer's stated limits, or the tracer died of it
};

/// A tracer fills in what it knows and says which fields it filled; a NaN in a given field is the tracer's own.
struct Answer {
  Outcome outcome = Outcome::miss;
  bool has_t = false;        ///< t is given
  bool has_uv = false;       ///< u (weight of b) and v (weight of c) are given
  bool has_segment = false;  ///< in and out are given
  std::uint32_t triangle = 0;
  double t = 0, u = 0, v = 0;
  double in = 0, out = 0;  ///< where the ray enters and leaves the object, as parameters along the ray
};

/// A piece of the ray inside the object: the ends as parameters along the ray, and the triangles that they belong to.
struct Passage {
  double in = 0, out = 0;
  std::uint32_t triangle_in = 0, triangle_out = 0;
  friend bool operator==(const Passage&, const Passage&) = default;
};

}  // namespace plumbline
