#include "float_tracer/adapters/irrlicht.h"

#include <irrlicht/IrrCompileConfig.h>
#include <irrlicht/triangle3d.h>

#include "float_tracer/adapters/prepared_triangles.h"

namespace plumbline {
namespace {

template <class Real>
using Vector = irr::core::vector3d<Real>;

template <class Real>
Vector<Real> to_irrlicht(const Vec3& v) {
  return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}

template <class Real>
struct Irrlicht {
  using Triangle = irr::core::triangle3d<Real>;
  struct Probe {
    Vector<Real> point, direction;
    Query query;
  };

  static Triangle to_triangle(const plumbline::Triangle& t) {
    return {to_irrlicht<Real>(t.a), to_irrlicht<Real>(t.b), to_irrlicht<Real>(t.c)};
  }

  static bool takes(const plumbline::Triangle&) { return true; }

  static std::optional<Probe> probe(const Ray& ray, double) {
    return Probe{.point = to_irrlicht<Real>(ray.origin), .direction = to_irrlicht<Real>(ray.direction), .query = ray};
  }

  static Answer intersect(const Triangle& triangle, const Probe& probe) {
    Vector<Real> at;
    if (!triangle.getIntersectionWithLine(probe.point, probe.direction, at)) return {};
    return {.outcome = Outcome::hit, .has_t = true, .t = parameter_of({at.X, at.Y, at.Z}, probe.query.ray)};
  }
};

template <class Real>
std::unique_ptr<Tracer> make() {
  return std::make_unique<TriangleTracer<Irrlicht<Real>>>(
      TracerInfo{.name = name_with_precision<Real>("irrlicht"),
                 .summary = "Irrlicht's test of a triangle with an infinite line",
                 .source = "irr::core::triangle3d::getIntersectionWithLine",
                 .package = "libirrlicht-dev " IRRLICHT_SDK_VERSION,
                 .contract = {.precision = precision_of<Real>(),
                              .range = RangeRule::line,
                              .coplanar = TouchRule::unspecified,
                              .degenerate = TouchRule::unspecified}});
}

}  // namespace

std::vector<std::unique_ptr<Tracer>> irrlicht_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(make<float>());
  list.push_back(make<double>());
  return list;
}

}  // namespace plumbline
