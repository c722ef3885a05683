#include "case/query.h"

#include "case/float_bits.h"

namespace plumbline {
namespace {

// Knuth, The Art of Computer Programming 2, 4.2.2, theorem B: x - y = difference + tail exactly.
struct Difference {
  double difference, tail;

  Difference(double x, double y) : difference(x - y) {
    const double minus_y = difference - x, part_x = difference - minus_y;
    tail = (x - part_x) - (y + minus_y);
  }
};

}  // namespace

std::optional<Query> query_through(const Vec3& origin, const Vec3& second, double t_min, double t_max) {
  const Difference x(second.x, origin.x), y(second.y, origin.y), z(second.z, origin.z);
  for (const Difference& d : {x, y, z})
    if (!is_finite(d.difference) || !is_finite(d.tail)) return std::nullopt;
  Query query = Ray{origin, {x.difference, y.difference, z.difference}, t_min, t_max};
  query.direction_tail = {x.tail, y.tail, z.tail};
  return query;
}

}  // namespace plumbline
