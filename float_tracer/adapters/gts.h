// GTS, the GNU Triangulated Surface Library (libgts-dev), gts_segment_triangle_intersection with boundary = TRUE;
// built only where CMake finds it.
//
// Its documentation: it "will not return a point if s and t do not intersect and will return a point if s and t do
// intersect", the boundary of t included; none "if s is contained in the plane". So: closed edges, closed ends,
// coplanar is a miss. Of triangles without area it says nothing.
//
// It takes a segment: see segment.h for its ends; t counts in the query through them. A ray that no segment
// can stand for, and every ray at a bag with a coordinate that is not finite, is Outcome::fault. t is read off the
// point that it returns, along the direction's largest component; that point is rounded, only its existence is not.
// Of several triangles the one with the least such t is named. The mode of the bag is not read.
//
// Oddities:
// - What it returns may be a vertex of the triangle or an end of the segment, not a new point: not to be destroyed
//   then.
// - Its signs are Shewchuk's adaptive predicates. They are exact while nothing under- or overflows, which their paper
//   promises for exponents from -142 to 201; beyond, GTS gives wrong answers without a word
//   (corpus/adapters/gts.case).
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// gts_segment_f64.
std::vector<std::unique_ptr<Tracer>> gts_tracers();

}  // namespace plumbline
