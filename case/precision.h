// Rounds a case to the precision that a tracer reads. What comes out is what was really asked, so the truth is asked
// for that.
#pragma once
#include "case/case.h"

namespace plumbline {

/// Each coordinate and bound to nearest, ties to even; binary64 changes nothing. A value beyond binary32's range
/// becomes infinite.
double at_precision(double x, Precision precision);
Vec3 at_precision(const Vec3& v, Precision precision);
Triangle at_precision(const Triangle& triangle, Precision precision);
Ray at_precision(const Ray& ray, Precision precision);
Bag at_precision(Bag bag, Precision precision);

}  // namespace plumbline
