// The Irrlicht engine (libirrlicht-dev), core::triangle3d<T>::getIntersectionWithLine, a template in its headers;
// built only where CMake finds it.
//
// It searches the whole line, and says so: t_min and t_max are not read. Points on the border "count also as inside":
// edges are closed. Of lines in the plane and of triangles without area it says nothing: unspecified. It answers with
// a point; t is worked out of it here. Directions of any length are taken as they are. The mode of the bag is not
// read: every triangle counts as a surface.
//
// Oddities:
// - Whatever T is, it computes in binary64. irrlicht_f32 rounds the point in the plane to binary32 before it asks
//   whether that lies inside the triangle.
// - A point outside an edge is still inside if the edge and the way from its start to the point, both normalized,
//   have a product of at most 1e-6 per component: within an angle of 1e-6 of the edge, and beyond its ends too as far
//   as the other two edges let it.
// - The same angle loses vertices: where the point in the plane is a rounding error away from the start of an edge,
//   the way to it points anywhere, so vertices are missed even on short dyadic coordinates.
// - A line is called parallel where |D . n| <= 1e-8, absolutely, n being of unit length and D not: short directions
//   miss every triangle.
// - In binary64, coordinates with squares of squares beyond its range (about 1e77 and 1e-81) make the tests of the
//   edges inf, NaN or zero: misses of what is inside, and hits of anything in the plane.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// irrlicht_f32 and irrlicht_f64.
std::vector<std::unique_ptr<Tracer>> irrlicht_tracers();

}  // namespace plumbline
