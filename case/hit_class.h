// The words for where the line through a ray meets the plane of a triangle.
#pragma once
#include <array>
#include <string_view>

namespace plumbline {

/// With det = direction . ((b-a) x (c-a)):
/// det != 0: the line crosses the plane once, in the triangle's interior, on an edge, on a vertex, or outside.
/// det == 0: the triangle has no area (degenerate), or the line runs in its plane (coplanar) or beside it (parallel).
/// invalid: a NaN or infinity among the coordinates, a NaN bound, or a zero direction.
enum class HitClass : unsigned char { interior, edge, vertex, exterior, parallel, coplanar, degenerate, invalid };

/// Which edge or vertex, for HitClass::edge and HitClass::vertex.
enum class Feature : unsigned char { none, ab, bc, ca, a, b, c };

inline constexpr std::array<std::string_view, 8> hit_class_names = {
    "interior", "edge", "vertex", "exterior", "parallel", "coplanar", "degenerate", "invalid"};
inline constexpr std::array<std::string_view, 7> feature_names = {"none", "ab", "bc", "ca", "a", "b", "c"};

constexpr std::string_view name(HitClass c) { return hit_class_names[static_cast<unsigned>(c)]; }
constexpr std::string_view name(Feature f) { return feature_names[static_cast<unsigned>(f)]; }

}  // namespace plumbline
