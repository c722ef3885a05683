#include "mesh/polygon_soup.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <sstream>

namespace plumbline {

std::optional<PolygonSoup> read_polygon_soup(std::string vetted, MeshFormat format) {
  std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
  PolygonSoup soup;
  std::istringstream file(std::move(vetted), std::ios::in | std::ios::binary);
  bool read = false;
  switch (format) {
    case MeshFormat::obj:
      read = CGAL::IO::read_OBJ(file, points, soup.polygons);
      break;
    case MeshFormat::ply:
      read = CGAL::IO::read_PLY(file, points, soup.polygons);
      break;
    case MeshFormat::stl:
      read = CGAL::IO::read_STL(file, points, soup.polygons);
      break;
  }
  if (!read) return std::nullopt;
  soup.points.reserve(points.size());
  for (const auto& p : points) soup.points.push_back({p.x(), p.y(), p.z()});
  return soup;
}

}  // namespace plumbline
