#include "fuzz/bench/lattice_search.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <vector>

#include "analysis/examine.h"
#include "case/precision.h"
#include "case/targets.h"

namespace plumbline {
namespace {

std::array<Vec3, 8> corners() {
  std::array<Vec3, 8> points;
  for (unsigned i = 0; i < 8; ++i)
    points[i] = {(i & 1) != 0 ? 1.5 : 0, (i & 2) != 0 ? 1.5 : 0, (i & 4) != 0 ? 1.5 : 0};
  return points;
}

// No three corners of a cube lie on a line, unless two are the same.
std::vector<Triangle> triangles(const std::array<Vec3, 8>& points) {
  std::vector<Triangle> list;
  for (const Vec3& a : points)
    for (const Vec3& b : points)
      for (const Vec3& c : points)
        if (a != b && b != c && c != a) list.push_back({a, b, c});
  return list;
}

}  // namespace

Summary lattice_search(const Tracer& tracer) {
  const auto begin = std::chrono::steady_clock::now();
  const auto points = corners();
  const Precision precision = tracer.info().contract.precision;
  const Aiming aiming;
  std::vector<Ray> rays(aims(aiming).size());
  Examiner examiner(tracer, Measure::wrong_answers);
  Summary s;
  s.tracer = tracer.info().name;
  for (const Triangle& triangle : triangles(points)) {
    aim_rays(triangle, aiming, rays);
    for (const Ray& aimed : rays)
      for (const Vec3& origin : points) {
        const auto target = [&](double o, double d) { return o + aiming.standoff * d; };
        Vec3 d = {target(aimed.origin.x, aimed.direction.x) - origin.x, target(aimed.origin.y, aimed.direction.y) - origin.y,
                  target(aimed.origin.z, aimed.direction.z) - origin.z};
        const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
        if (!(length > 0)) continue;
        d = {d.x / length, d.y / length, d.z / length};
        ++s.executions;
        const Examination e = examiner.examine(triangle, at_precision(Ray{origin, d}, precision));
        if (e.severity_ulps() > 0 && !s.first_disagreement) s.first_disagreement = s.executions;
        if (e.nominal()) s.worst_nominal_severity = std::max(s.worst_nominal_severity, e.severity_ulps());
      }
  }
  s.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return s;
}

}  // namespace plumbline
