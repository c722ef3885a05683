// An independent judge of a bag: all its intersections with a ray, constructed exactly by CGAL's EPECK and sorted.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "case/geometry.h"

namespace plumbline::judges {

struct EpeckHit {
  std::uint32_t triangle, rank;  ///< as BagHit
};

struct EpeckBag {
  std::vector<EpeckHit> hits;
  std::vector<std::uint32_t> stretches;  ///< the triangles that are touched
};

/// What is asked is valid.
EpeckBag epeck_bag(std::span<const Triangle> triangles, const Ray& ray);

}  // namespace plumbline::judges
