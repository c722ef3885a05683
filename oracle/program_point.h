// The point of a hit as a program has it: computed at its precision, each operation rounded to nearest.
#pragma once
#include "case/case.h"
#include "case/geometry.h"

namespace plumbline {

/// origin + t * direction.
Vec3 point_at(const Ray& ray, double t, Precision precision);

/// (a + u * (b - a)) + v * (c - a).
Vec3 point_at(const Triangle& triangle, double u, double v, Precision precision);

}  // namespace plumbline
