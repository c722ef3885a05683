// VTK (libvtk9-dev): vtkTriangle::IntersectWithLine, and the same method of three locators, which search a mesh of
// the bag's triangles. Half a gigabyte to install, so built only with the option PLUMBLINE_VTK.
//
// A query is a segment; segment.h says which. Of a cell the documentation says that t lies between 0 and 1 and
// that the test of the triangle "is performed using tol as the tolerance"; of edges, the segment's ends, segments in
// the plane and triangles without area it says nothing: all unspecified. The tolerance is a length, 0 unless the name
// says otherwise. A coordinate that is not finite, or a ray without a segment, is Outcome::fault. VTK's warnings are
// switched off, for the process: vtkOBBTree prints them of small triangles. The mode of the bag is not read: every
// triangle counts as a surface.
//
// Oddities, in 9.1:
// - The tolerance is an absolute length: a triangle smaller than it is hit from far beside it.
// - A segment in the plane of the triangle is a hit where it passes inside, and where the vertices are collinear, so
//   is one that meets them.
// - Where products of coordinates overflow (coordinates from about 1e77), everything misses. Of a tiny bag (1e-100)
//   vtkCellLocator alone finds nothing.
// - vtkOBBTree's other IntersectWithLine, for all crossings, asks for a closed surface and works with its own
//   tolerance, 0.01 unless set; it is not the one asked here, which takes its tolerance as an argument.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// vtk_triangle, vtk_triangle_tolerant (1e-6), vtk_obb_tree, vtk_cell_locator and vtk_static_cell_locator.
std::vector<std::unique_ptr<Tracer>> vtk_tracers();

}  // namespace plumbline
