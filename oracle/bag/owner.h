// Who owns a hit that several triangles share.
//
// Turn the ray's direction aside by (e1, e2, e3), infinitely small and each infinitely smaller than the one before, the
// origin fixed: then it meets no edge and no vertex, and it crosses exactly one of the triangles around a shared edge,
// and of those around a vertex a number that leaves inside and outside consistent. Those own the hit. (Simulation of
// simplicity, Edelsbrunner and Muecke, ACM Transactions on Graphics 9(1), 1990.)
#pragma once
#include "case/query.h"
#include "oracle/truth.h"

namespace plumbline {

/// Of a triangle that the line crosses. Interior: yes. Without meaning where the origin lies on the triangle's edge.
bool owns(const Triangle& triangle, const Query& query, const Truth& truth);

}  // namespace plumbline
