#include "float_tracer/adapters/ogre.h"

#include <OGRE/OgreMath.h>
#include <OGRE/OgreRay.h>
#include <OGRE/OgreVector.h>

#include <type_traits>

#include "float_tracer/adapters/prepared_triangles.h"

namespace plumbline {
namespace {

static_assert(std::is_same_v<Ogre::Real, float>, "OGRE was built for double precision: this adapter says binary32");

Ogre::Vector3 to_ogre(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

struct OgreMath {
  struct Triangle {
    Ogre::Vector3 a, b, c;
  };
  struct Probe {
    Ogre::Ray ray;
    Query query;
  };

  static Triangle to_triangle(const plumbline::Triangle& t) { return {to_ogre(t.a), to_ogre(t.b), to_ogre(t.c)}; }

  static bool takes(const plumbline::Triangle& t) { return is_finite(t); }

  static std::optional<Probe> probe(const Ray& ray, double) {
    if (!is_finite(ray.origin) || !is_finite(ray.direction)) return std::nullopt;
    return Probe{.ray = {to_ogre(ray.origin), to_ogre(ray.direction)}, .query = ray};
  }

  static Answer intersect(const Triangle& triangle, const Probe& probe) {
    const auto [hit, t] = Ogre::Math::intersects(probe.ray, triangle.a, triangle.b, triangle.c, true, true);
    if (!hit) return {};
    return {.outcome = Outcome::hit, .has_t = true, .t = t};
  }
};

#define PLUMBLINE_TEXT(x) #x
#define PLUMBLINE_VERSION(major, minor, patch) \
  PLUMBLINE_TEXT(major) "." PLUMBLINE_TEXT(minor) "." PLUMBLINE_TEXT(patch)

}  // namespace

std::vector<std::unique_ptr<Tracer>> ogre_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(std::make_unique<TriangleTracer<OgreMath>>(TracerInfo{
      .name = "ogre_f32",
      .summary = "OGRE's test of a triangle from both sides",
      .source = "Ogre::Math::intersects",
      .package = "libogre-1.12-dev " PLUMBLINE_VERSION(OGRE_VERSION_MAJOR, OGRE_VERSION_MINOR, OGRE_VERSION_PATCH),
      .contract = {.precision = Precision::binary32,
                   .edges = EdgeRule::unspecified,
                   .range = RangeRule::ray,
                   .t_min = EndRule::unspecified,
                   .coplanar = TouchRule::unspecified,
                   .degenerate = TouchRule::unspecified}}));
  return list;
}

}  // namespace plumbline
