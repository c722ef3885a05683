// Drawings of a case as inline SVG: the triangle as a whole, and so near that an ulp is seen. All that decides is
// computed exactly (oracle/outline.h); the drawing itself needs no more than pixels.
#pragma once
#include <span>
#include <string>

#include "findings/finding_row.h"
#include "findings/pages/look.h"
#include "oracle/bag/bag_truth.h"

namespace plumbline {

/// An SVG and what it shows, in words; both empty where there is nothing to draw.
struct Picture {
  std::string svg, caption;  ///< the caption is plain text
};

/// The triangle in its plane, and where the ray meets that.
Picture whole_triangle(const FindingRow& row, const Look& look);

/// What the answer has wrong, magnified: along the ray at an edge or vertex, from the side at the plane or at an end
/// of the ray's range.
Picture disagreement(const FindingRow& row, const Look& look);

/// Several triangles, looked at along the ray: a drawing in rounded numbers.
Picture along_the_ray(std::span<const Triangle> triangles, const Query& query, const BagTruth& truth);

}  // namespace plumbline
