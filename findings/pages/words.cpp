#include "findings/pages/words.h"

#include <fmt/format.h>

#include <cmath>

namespace plumbline {

std::string short_number(double x) {
  if (!std::isfinite(x)) return fmt::format("{}", x);
  if (x != 0 && (std::abs(x) >= 1e6 || std::abs(x) < 1e-3)) {
    std::string text = fmt::format("{:.2e}", x);  // 1.65e+14
    const auto e = text.find('e');
    return text.substr(0, e + 1) + std::to_string(std::stoi(text.substr(e + 1)));
  }
  return std::abs(x) >= 100 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x);
}

std::string in_ulps(double ulps) { return short_number(ulps) + (ulps == 1 ? " ulp" : " ulps"); }

std::string part_name(Element element) {
  switch (element) {
    case Element::ab: return "edge AB";
    case Element::bc: return "edge BC";
    case Element::ca: return "edge CA";
    case Element::a: return "vertex A";
    case Element::b: return "vertex B";
    case Element::c: return "vertex C";
    case Element::plane: return "the triangle's plane";
    case Element::t_min: return "the start of the ray's range";
    case Element::t_max: return "the end of the ray's range";
    case Element::none: break;
  }
  return "the triangle";
}

std::string what_is_wrong(const FindingRow& row) {
  const std::string part = part_name(row.element);
  const bool boundary = row.signature.find("-exactly-") != std::string::npos;
  switch (row.kind) {
    case FindingKind::false_hit:
      if (row.worst.what.bag.triangles.size() > 1) return "reports a hit where the ray misses";
      if (boundary) return fmt::format("calls this a hit; the ray meets {} exactly, where it promises a miss", part);
      switch (row.element) {
        case Element::plane: return "calls this a hit; the ray runs beside the triangle's plane and never meets it";
        case Element::t_min: return "calls this a hit; the triangle lies before the start of the ray's range";
        case Element::t_max: return "calls this a hit; the triangle lies behind the end of the ray's range";
        case Element::none: return "calls this a hit; the ray misses the triangle";
        case Element::a:
        case Element::b:
        case Element::c: return fmt::format("calls this a hit; the ray passes by {}, outside", part);
        default: return fmt::format("calls this a hit; the ray passes outside {}", part);
      }
    case FindingKind::false_miss:
      if (boundary) return fmt::format("misses this; the ray meets {} exactly, where it promises a hit", part);
      switch (row.element) {
        case Element::t_min:
        case Element::t_max: return fmt::format("misses this; the ray meets the triangle, close to {}", part);
        case Element::none: return "misses this; the ray meets the triangle";
        case Element::a:
        case Element::b:
        case Element::c: return fmt::format("misses this; the ray meets the triangle at {}", part);
        default: return fmt::format("misses this; the ray passes inside {}", part);
      }
    case FindingKind::displaced:
      return row.element == Element::plane ? "hits rightly, but with a t whose point is far off the triangle's plane"
                                           : "hits rightly, but with a u and v of another point of the triangle";
    case FindingKind::not_finite: return "hits rightly, but with a t, u or v that is no finite number";
    case FindingKind::death: return "dies of this case";
    case FindingKind::leak: return "misses triangles of which the ray has to hit one";
    case FindingKind::wrong_nearest: return "hits another triangle than the ray has to hit first";
  }
  return "";
}

std::string how_bad(double ulps, double longest_edge_ulps) {
  const double part = ulps / longest_edge_ulps;
  std::string text = ulps < 1      ? "less than the rounding of one coordinate"
                     : ulps < 16   ? "as much as the rounding of a few coordinates"
                     : ulps < 1024 ? "well beyond the rounding of the coordinates"
                                   : "far beyond the rounding of the coordinates";
  if (longest_edge_ulps > 0) {
    if (part >= 1)
      text += fmt::format(", and {} times the triangle's longest edge", short_number(part));
    else if (part >= 0.001)
      text += fmt::format(", and {} % of the triangle's longest edge", short_number(100 * part));
    else
      text += fmt::format("; the triangle's longest edge is {}", in_ulps(longest_edge_ulps));
  }
  return text;
}

}  // namespace plumbline
