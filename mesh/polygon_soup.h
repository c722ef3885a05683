// Polygons as CGAL's readers give them (CGAL/IO/polygon_soup_io.h, LGPL): nothing is checked here. Private to mesh.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "case/geometry.h"
#include "mesh/read_mesh.h"

namespace plumbline {

struct PolygonSoup {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> polygons;  ///< a negative index becomes one beyond all points
};

/// Of bytes that were vetted. No value if CGAL can't read them.
std::optional<PolygonSoup> read_polygon_soup(std::string vetted, MeshFormat format);

}  // namespace plumbline
