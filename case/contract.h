// What a tracer promises, declared from its documentation. The judge judges against this; where a contract is silent
// the verdict is "unspecified", never wrong.
#pragma once
#include <array>
#include <string_view>

#include "case/case.h"

namespace plumbline {

/// What happens on the boundary of a triangle: its edges and vertices.
enum class EdgeRule : unsigned char {
  closed,     ///< they belong to the triangle: must hit
  open,       ///< they don't: must miss
  one_owner,  ///< exactly one of the triangles that share them is hit: a single triangle may do either
  unspecified,
};
inline constexpr std::array<std::string_view, 4> edge_rule_names = {"closed", "open", "one_owner", "unspecified"};
constexpr std::string_view name(EdgeRule r) { return edge_rule_names[static_cast<unsigned>(r)]; }

/// Whether an end of the t range belongs to it.
enum class EndRule : unsigned char { closed, open, unspecified };
inline constexpr std::array<std::string_view, 3> end_rule_names = {"closed", "open", "unspecified"};
constexpr std::string_view name(EndRule r) { return end_rule_names[static_cast<unsigned>(r)]; }

/// Which range of t a tracer searches.
enum class RangeRule : unsigned char {
  given,  ///< the ray's own t_min and t_max
  ray,    ///< [0, inf), whatever the ray says: t_min and t_max are not read
  line,   ///< (-inf, inf)
};
inline constexpr std::array<std::string_view, 3> range_rule_names = {"given", "ray", "line"};
constexpr std::string_view name(RangeRule r) { return range_rule_names[static_cast<unsigned>(r)]; }

/// What a ray that touches the triangle without crossing it counts as: one that runs in its plane, or one that meets
/// a triangle without area.
enum class TouchRule : unsigned char { hit, miss, unspecified };
inline constexpr std::array<std::string_view, 3> touch_rule_names = {"hit", "miss", "unspecified"};
constexpr std::string_view name(TouchRule r) { return touch_rule_names[static_cast<unsigned>(r)]; }

/// Which side of a triangle is not hit. The front is where the vertices appear counter-clockwise. Contact without a
/// crossing has no side: coplanar and degenerate settle it.
enum class Culling : unsigned char { none, back, front };
inline constexpr std::array<std::string_view, 3> culling_names = {"none", "back", "front"};
constexpr std::string_view name(Culling c) { return culling_names[static_cast<unsigned>(c)]; }

struct Contract {
  Precision precision = Precision::binary64;  ///< the inputs it reads; a binary32 tracer is put only binary32 values
  EdgeRule edges = EdgeRule::closed;
  RangeRule range = RangeRule::given;
  EndRule t_min = EndRule::closed;  ///< the near end of that range
  EndRule t_max = EndRule::closed;  ///< the far end
  TouchRule coplanar = TouchRule::miss;
  TouchRule degenerate = TouchRule::miss;
  Culling culling = Culling::none;
  double slack_absolute = 0;  ///< by how much it says it widens a triangle, as a length: excuses a hit that is as near
  double slack_relative = 0;  ///< the same, as a multiple of the triangle's longest edge
};

}  // namespace plumbline
