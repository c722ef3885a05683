// The bag of a library that tests one triangle at a time: the loop of many rays over its triangles. The nearest hit
// is the answer; of several at the same t, the first triangle's. The mode of the bag is not read: every triangle
// counts as a surface. Nothing is allocated per ray.
//
// A Library is a type with
//   Triangle                what the library reads;
//   to_triangle(triangle)   makes it of ours;
//   takes(triangle)         whether the library's limits allow it: every ray at a bag with another is a fault;
//   Probe                   a ray as the library reads it, and in its member `query` as the oracle does;
//   probe(ray, largest)     std::optional<Probe>, empty where the library can't take the ray, which is a fault;
//                           `largest` is the largest magnitude of a coordinate of the bag;
//   intersect(triangle, probe)   the library's Answer; t counts in the query.
// All functions are static.
#pragma once
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "case/finite.h"
#include "float_tracer/adapters/nearest.h"
#include "float_tracer/adapters/segment.h"
#include "float_tracer/tracer.h"

namespace plumbline {

template <class Library>
class PreparedTriangles final : public PreparedBag {
 public:
  explicit PreparedTriangles(const Bag& bag) : largest_(largest_coordinate(bag)) {
    triangles_.reserve(bag.triangles.size());
    for (const Triangle& t : bag.triangles) {
      takes_ = takes_ && Library::takes(t);
      triangles_.push_back(Library::to_triangle(t));
    }
  }

  Query asked(const Ray& ray) override {
    const auto probe = Library::probe(ray, largest_);
    return probe ? probe->query : Query(ray);
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = answer(rays[i]);
  }

  Answer answer(const Ray& ray) const {
    const auto probe = Library::probe(ray, largest_);
    if (!takes_ || !probe) return {.outcome = Outcome::fault};
    return nearest(triangles_, [&](const auto& triangle) { return Library::intersect(triangle, *probe); });
  }

  std::vector<typename Library::Triangle> triangles_;
  double largest_;
  bool takes_ = true;
};

/// A tracer whose bags are PreparedTriangles<Library>.
template <class Library>
class TriangleTracer final : public Tracer {
 public:
  using Tracer::Tracer;
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<PreparedTriangles<Library>>(bag);
  }
};

template <class Real>
constexpr Precision precision_of() {
  return std::is_same_v<Real, float> ? Precision::binary32 : Precision::binary64;
}

/// NAME_f32 or NAME_f64.
template <class Real>
std::string name_with_precision(const char* name) {
  return std::string(name) + (std::is_same_v<Real, float> ? "_f32" : "_f64");
}

/// Where the point lies on the line of the query: t along the largest component of the direction, in binary64. For
/// libraries that answer with a point.
inline double parameter_of(const Vec3& point, const Ray& line) {
  const Vec3& d = line.direction;
  const double x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
  if (x >= y && x >= z) return (point.x - line.origin.x) / d.x;
  return y >= z ? (point.y - line.origin.y) / d.y : (point.z - line.origin.z) / d.z;
}

}  // namespace plumbline
