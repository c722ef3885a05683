#include "case/precision.h"

namespace plumbline {

double at_precision(double x, Precision precision) {
  return precision == Precision::binary32 ? static_cast<double>(static_cast<float>(x)) : x;
}

Vec3 at_precision(const Vec3& v, Precision p) { return {at_precision(v.x, p), at_precision(v.y, p), at_precision(v.z, p)}; }

Triangle at_precision(const Triangle& t, Precision p) {
  return {at_precision(t.a, p), at_precision(t.b, p), at_precision(t.c, p)};
}

Ray at_precision(const Ray& r, Precision p) {
  return {at_precision(r.origin, p), at_precision(r.direction, p), at_precision(r.t_min, p), at_precision(r.t_max, p)};
}

Bag at_precision(Bag bag, Precision p) {
  for (Triangle& t : bag.triangles) t = at_precision(t, p);
  bag.thickness = at_precision(bag.thickness, p);
  return bag;
}

}  // namespace plumbline
