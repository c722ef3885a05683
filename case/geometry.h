// The geometry of a case: plain binary64 values, taken as the exact rationals that they are.
#pragma once
#include <limits>

namespace plumbline {

struct Vec3 {
  double x = 0, y = 0, z = 0;
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

struct Triangle {
  Vec3 a, b, c;
  friend bool operator==(const Triangle&, const Triangle&) = default;
};

/// The points origin + t * direction with t_min <= t <= t_max. The direction need not have unit length; t is a
/// parameter along it, not a distance.
struct Ray {
  Vec3 origin, direction;
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();
  friend bool operator==(const Ray&, const Ray&) = default;
};

}  // namespace plumbline
