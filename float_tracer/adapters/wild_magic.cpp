#include "float_tracer/adapters/wild_magic.h"

#include <libwildmagic/Wm5IntrRay3Triangle3.h>

#include "float_tracer/adapters/prepared_triangles.h"
#include "float_tracer/adapters/segment.h"

namespace plumbline {
namespace {

template <class Real>
Wm5::Vector3<Real> to_wild_magic(const Vec3& v) {
  return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}

template <class Real>
Vec3 from_wild_magic(const Wm5::Vector3<Real>& v) {
  return {v.X(), v.Y(), v.Z()};
}

// Of unit length, as nearly as rounding lets. Scaled first: nothing over- or underflows on the way.
std::optional<Vec3> unit(const Vec3& v) {
  const double largest = largest_component(v);
  if (!is_finite(v) || is_zero(largest)) return std::nullopt;
  const int down = -std::ilogb(largest);
  const double x = std::scalbn(v.x, down), y = std::scalbn(v.y, down), z = std::scalbn(v.z, down);
  const double length = std::sqrt(x * x + y * y + z * z);
  return Vec3{x / length, y / length, z / length};
}

template <class Real>
struct WildMagic {
  using Triangle = Wm5::Triangle3<Real>;
  struct Probe {
    Wm5::Ray3<Real> ray;
    Query query;
  };

  static Triangle to_triangle(const plumbline::Triangle& t) {
    return {to_wild_magic<Real>(t.a), to_wild_magic<Real>(t.b), to_wild_magic<Real>(t.c)};
  }

  static bool takes(const plumbline::Triangle&) { return true; }

  static std::optional<Probe> probe(const Ray& ray, double) {
    const auto direction = unit(ray.direction);
    if (!direction) return std::nullopt;
    Probe probe{.ray = {to_wild_magic<Real>(ray.origin), to_wild_magic<Real>(*direction)}, .query = ray};
    probe.query.ray.direction = from_wild_magic(probe.ray.Direction);
    return probe;
  }

  static Answer intersect(const Triangle& triangle, const Probe& probe) {
    Wm5::IntrRay3Triangle3<Real> intersector(probe.ray, triangle);
    if (!intersector.Find()) return {};
    return {.outcome = Outcome::hit,
            .has_t = true,
            .has_uv = true,
            .t = intersector.GetRayParameter(),
            .u = intersector.GetTriBary1(),
            .v = intersector.GetTriBary2()};
  }
};

template <class Real>
std::unique_ptr<Tracer> make() {
  return std::make_unique<TriangleTracer<WildMagic<Real>>>(
      TracerInfo{.name = name_with_precision<Real>("wild_magic"),
                 .summary = "Wild Magic 5, asked with directions of unit length",
                 .source = "Wm5::IntrRay3Triangle3::Find",
                 .package = "libwildmagic-dev " PLUMBLINE_WILD_MAGIC_VERSION,
                 .contract = {.precision = precision_of<Real>(),
                              .edges = EdgeRule::unspecified,
                              .range = RangeRule::ray,
                              .coplanar = TouchRule::unspecified,
                              .degenerate = TouchRule::unspecified},
                 .own_queries = true});
}

}  // namespace

std::vector<std::unique_ptr<Tracer>> wild_magic_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(make<float>());
  list.push_back(make<double>());
  return list;
}

}  // namespace plumbline
