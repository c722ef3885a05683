#include "float_tracer/adapters/gz_math.h"

#include <ignition/math/Line3.hh>
#include <ignition/math/Triangle3.hh>
#include <ignition/math/config.hh>

#include "float_tracer/adapters/prepared_triangles.h"
#include "float_tracer/adapters/segment.h"

namespace plumbline {
namespace {

namespace gz = ignition::math;

template <class Real>
gz::Vector3<Real> to_gz(const Vec3& v) {
  return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}

template <class Real>
struct GzMath {
  using Triangle = gz::Triangle3<Real>;
  struct Probe {
    gz::Line3<Real> line;
    Query query;
  };

  static Triangle to_triangle(const plumbline::Triangle& t) {
    return {to_gz<Real>(t.a), to_gz<Real>(t.b), to_gz<Real>(t.c)};
  }

  static bool takes(const plumbline::Triangle& t) { return is_finite(t); }

  static std::optional<Probe> probe(const Ray& ray, double largest) {
    const auto segment = segment_of(ray, largest, precision_of<Real>());
    if (!segment) return std::nullopt;
    return Probe{.line = {to_gz<Real>(segment->from), to_gz<Real>(segment->to)}, .query = segment->query};
  }

  static Answer intersect(const Triangle& triangle, const Probe& probe) {
    gz::Vector3<Real> at;
    if (!triangle.Intersects(probe.line, at)) return {};
    return {.outcome = Outcome::hit, .has_t = true, .t = parameter_of({at.X(), at.Y(), at.Z()}, probe.query.ray)};
  }
};

template <class Real>
std::unique_ptr<Tracer> make() {
  return std::make_unique<TriangleTracer<GzMath<Real>>>(
      TracerInfo{.name = name_with_precision<Real>("gz_math"),
                 .summary = "Gazebo Math's test of a triangle with a segment",
                 .source = "ignition::math::Triangle3::Intersects",
                 .package = "libignition-math-dev " IGNITION_MATH_VERSION_FULL,
                 .contract = {.precision = precision_of<Real>(),
                              .t_min = EndRule::unspecified,
                              .t_max = EndRule::unspecified,
                              .coplanar = TouchRule::hit,
                              .degenerate = TouchRule::unspecified},
                 .own_queries = true});
}

}  // namespace

std::vector<std::unique_ptr<Tracer>> gz_math_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(make<float>());
  list.push_back(make<double>());
  return list;
}

}  // namespace plumbline
