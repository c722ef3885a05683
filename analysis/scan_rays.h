// Rays for a mesh, aimed at what hurts: edges, vertices, slivers, silhouettes; all over it; and grids of shotlines.
//
// A ray is a function of mesh, seed, aim and index, whatever else is asked, so that a scan can be split over threads,
// cut off and taken up. Its numbers are of the mesh's precision, its range is [0, inf].
#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace plumbline {

enum class ScanAim : unsigned char { uniform, edge, vertex, sliver, silhouette };
inline constexpr std::array<std::string_view, 5> scan_aim_names = {"uniform", "edge", "vertex", "sliver", "silhouette"};
constexpr std::string_view name(ScanAim a) { return scan_aim_names[static_cast<unsigned>(a)]; }
inline constexpr std::array<std::string_view, 5> scan_aim_summaries = {
    "from anywhere around or in the mesh to anywhere in its box",
    "at a point of an edge, within rounding; half of them moved by an ulp in a component of the direction",
    "at a vertex, exactly or within rounding; half of them moved likewise",
    "at a point inside of one of the thinnest triangles (the thinnest 64th of all)",
    "through a point of an edge, along the plane of one of its triangles: where the mesh turns away"};
constexpr std::string_view summary(ScanAim a) { return scan_aim_summaries[static_cast<unsigned>(a)]; }

/// Whether rays around a mesh of such points, and from one to another, don't overflow: an eighth of the largest number.
bool has_room(const Vec3& point, Precision precision);

class ScanRays {
 public:
  /// Keeps a reference. The mesh has triangles. Throws InputError where a vertex has no room.
  ScanRays(const Mesh& mesh, std::uint64_t seed);

  Ray ray(ScanAim aim, std::uint64_t index) const;

 private:
  const Mesh& mesh_;
  std::uint64_t seed_;
  Vec3 low_, high_;                     // the mesh's box
  std::vector<std::uint32_t> slivers_;  // triangles
};

/// Parallel rays on a square grid that covers the mesh, as vulnerability codes in the manner of FASTGEN fire them:
/// looking along -(cos a cos e, sin a cos e, sin e), cells across (-sin a, cos a, 0) and up (-cos a sin e, -sin a sin
/// e, cos e), from in front of the mesh, in the middle of each cell. Angles in degrees; multiples of 90 are exact.
class ShotlineGrid {
 public:
  /// As few cells as cover the mesh, centred on it. Throws InputError where a vertex has no room, the cell is not
  /// positive and finite, an angle not finite, or the grid has more than 10^9 cells.
  ShotlineGrid(const Mesh& mesh, double azimuth, double elevation, double cell);

  std::uint64_t size() const { return columns_ * rows_; }
  Ray ray(std::uint64_t index) const;  ///< row by row from the bottom left

 private:
  Precision precision_;
  double cell_;
  Vec3 eye_, across_, up_;
  double left_, bottom_, front_;
  std::uint64_t columns_, rows_;
};

}  // namespace plumbline
