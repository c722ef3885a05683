#include "findings/pages/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <vector>

#include "case/float_bits.h"
#include "findings/pages/words.h"
#include "oracle/outline.h"

namespace plumbline {
namespace {

constexpr double width = 400, height = 280;  // of a picture, in its own units
constexpr std::array<const char*, 3> corner_names = {"A", "B", "C"}, edge_names = {"AB", "BC", "CA"};

Point2 operator+(Point2 p, Point2 q) { return {p.x + q.x, p.y + q.y}; }
Point2 operator*(double k, Point2 p) { return {k * p.x, k * p.y}; }
double dot(Point2 p, Point2 q) { return p.x * q.x + p.y * q.y; }
double length(Point2 p) { return std::hypot(p.x, p.y); }
bool finite(Point2 p) { return is_finite(p.x) && is_finite(p.y); }

/// Shapes in coordinates whose y goes up, onto an SVG whose y goes down.
class Drawing {
 public:
  /// (0, 0) of the coordinates is at `origin` of the picture.
  Drawing(Point2 origin, double scale, double stretch = 1) : origin_(origin), x_(scale), y_(scale * stretch) {}

  Point2 at(Point2 p) const { return {origin_.x + x_ * p.x, origin_.y - y_ * p.y}; }

  void polygon(const std::vector<Point2>& points, const char* style) {
    std::string list;
    for (const Point2& p : points) list += fmt::format("{:.2f},{:.2f} ", at(p).x, at(p).y);
    add("<polygon class=\"{}\" points=\"{}\"/>", style, list);
  }
  void line(Point2 from, Point2 to, const char* style) {
    const Point2 p = at(from), q = at(to);
    add("<line class=\"{}\" x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\"/>", style, p.x, p.y, q.x, q.y);
  }
  void dot(Point2 where, const char* style) {
    add("<circle class=\"{}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"5\"/>", style, at(where).x, at(where).y);
  }
  void cross(Point2 where, const char* style) {
    const Point2 p = at(where);
    add("<path class=\"{}\" d=\"M{:.2f} {:.2f}l10 10m0 -10l-10 10\"/>", style, p.x - 5, p.y - 5);
  }
  /// Beside the place, by (dx, dy) of the picture; kept within it, and off what is written already, where there is
  /// room.
  void text(Point2 where, double dx, double dy, std::string_view words, const char* style = "label") {
    const double wide = 7.2 * static_cast<double>(words.size());
    const double x = std::clamp(at(where).x + dx, 4 + wide / 2, std::max(4 + wide / 2, width - 4 - wide / 2));
    const double wanted = at(where).y + dy;
    double y = std::clamp(wanted, 16.0, height - 6);
    const auto taken = [&](double line) {
      return line < 16 || line > height - 6 || std::ranges::any_of(written_, [&](const Written& w) {
               return std::abs(w.x - x) < (w.wide + wide) / 2 && std::abs(w.y - line) < 15;
             });
    };
    for (const double away : {0, 16, -16, 32, -32, 48, -48})
      if (!taken(wanted + away)) {
        y = wanted + away;
        break;
      }
    written_.push_back({x, y, wide});
    add("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", style, x, y, words);
  }
  /// In the lower left corner: a round number of units that is at most a third of the picture.
  void scale_bar(const std::function<std::string(double)>& words) {
    const double most = width / 3 / x_, power = std::pow(10, std::floor(std::log10(most)));
    const double round = power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1), wide = round * x_;
    add("<path class=\"bar\" d=\"M12 {0}v8m0 -4h{1:.2f}m0 -4v8\"/>", height - 18, wide);
    add("<text class=\"label start\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", 20 + wide, height - 9, words(round));
  }
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(svg_), format, std::forward<Args>(args)...);
  }
  std::string take(std::string_view label) const {
    return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">{}</svg>", width, height, label,
                       svg_);
  }

 private:
  struct Written {
    double x, y, wide;
  };

  std::vector<Written> written_;
  Point2 origin_;
  double x_, y_;
  std::string svg_;
};

/// The points p with dot(inward, p) + depth >= 0.
struct HalfPlane {
  Point2 inward;  // of length 1
  double depth = 0;
  double over(Point2 p) const { return dot(inward, p) + depth; }
  Point2 foot() const { return -depth * inward; }  // nearest to (0, 0)
};

std::vector<Point2> clipped(const std::vector<Point2>& polygon, const HalfPlane& side) {
  std::vector<Point2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double over_p = side.over(p), over_q = side.over(q);
    if (over_p >= 0) kept.push_back(p);
    if ((over_p < 0) != (over_q < 0)) kept.push_back(p + over_p / (over_p - over_q) * (q + -1.0 * p));
  }
  return kept;
}

std::vector<HalfPlane> window(double half_width, double half_height) {
  return {{{1, 0}, half_width}, {{-1, 0}, half_width}, {{0, 1}, half_height}, {{0, -1}, half_height}};
}

/// The part of a half-plane's border that is in all of `sides`: two points, or none.
std::vector<Point2> border_within(const HalfPlane& border, const std::vector<HalfPlane>& sides) {
  const Point2 along{border.inward.y, -border.inward.x}, foot = border.foot();
  double low = -HUGE_VAL, high = HUGE_VAL;
  for (const HalfPlane& side : sides) {
    const double at_foot = side.over(foot), slope = dot(side.inward, along);
    if (slope > 0)
      low = std::max(low, -at_foot / slope);
    else if (slope < 0)
      high = std::min(high, -at_foot / slope);
    else if (at_foot < 0)
      return {};
  }
  if (!(low < high)) return {};
  return {foot + low * along, foot + high * along};
}

/// The triangle as its three sides around the ray, in ulps: depths are exact, and so are they near a far corner.
struct Sides {
  std::array<HalfPlane, 3> side;  // ab, bc, ca
  std::array<Point2, 3> corner, edge;
};

std::optional<Sides> sides(const Look& look, unsigned base) {
  const auto outline = seen_along_ray(look.triangle, look.query, base);
  if (!outline || !look.margins) return std::nullopt;
  const Margins& m = *look.margins;
  const std::array<double, 3> depth = {m.v * m.v_scale, m.w * m.w_scale, m.u * m.u_scale};
  const bool counter_clockwise = outline->edge[base].x > 0;
  Sides s;
  for (unsigned k = 0; k < 3; ++k) {
    s.corner[k] = 1 / m.ulp * outline->corner[k];
    s.edge[k] = 1 / m.ulp * outline->edge[k];
    const Point2 e = 1 / length(s.edge[k]) * s.edge[k];
    s.side[k] = {counter_clockwise ? Point2{-e.y, e.x} : Point2{e.y, -e.x}, depth[k] / m.ulp};
    if (!finite(s.corner[k]) || !finite(s.side[k].inward) || !is_finite(s.side[k].depth)) return std::nullopt;
  }
  return s;
}

/// Of a ray inside: the nearest point of the border. Of one outside: the nearest of the triangle.
Point2 nearest(const Sides& s) {
  std::vector<Point2> candidates(s.corner.begin(), s.corner.end());
  const bool inside = std::ranges::all_of(s.side, [](const HalfPlane& h) { return h.depth >= 0; });
  for (unsigned k = 0; k < 3; ++k) {
    const Point2 foot = s.side[k].foot();
    const auto within = [&](const HalfPlane& h) { return h.over(foot) >= -1e-9 * length(foot); };
    if (inside || (within(s.side[(k + 1) % 3]) && within(s.side[(k + 2) % 3]))) candidates.push_back(foot);
  }
  return *std::ranges::min_element(candidates, {}, [](Point2 p) { return length(p); });
}

unsigned base_edge(Element element, const Margins& m) {
  switch (element) {
    case Element::ab:
    case Element::a: return 0;
    case Element::bc:
    case Element::b: return 1;
    case Element::ca:
    case Element::c: return 2;
    default: break;
  }
  const std::array<double, 3> depth = {m.v * m.v_scale, m.w * m.w_scale, m.u * m.u_scale};
  return static_cast<unsigned>(std::ranges::min_element(depth, {}, [](double d) { return std::abs(d); }) -
                               depth.begin());
}

/// Where the u and v of the answer are, relative to the true ones: e1 and e2 are edges ab and ca.
std::optional<Point2> answered_point(const Look& look, Point2 ab, Point2 ca) {
  if (!look.answer || look.answer->outcome != Outcome::hit || !look.answer->has_uv || !look.margins)
    return std::nullopt;
  const double du = look.answer->u - look.margins->u, dv = look.answer->v - look.margins->v;
  const Point2 p = du * ab + -dv * ca;
  if (!finite(p)) return std::nullopt;
  return p;
}

// What a view doesn't show of the distance.
std::string beyond(const FindingRow& row, const Look& look, double seen) {
  if (row.kind != FindingKind::false_hit || look.ulps <= 1.01 * seen) return "";
  return fmt::format(" In all, its range included, it is {} away from the triangle.", in_ulps(look.ulps));
}

Picture from_along_the_ray(const FindingRow& row, const Look& look) {
  if (!look.margins) return {};
  const auto s = sides(look, base_edge(row.element, *look.margins));
  if (!s) return {};
  const bool displaced = row.kind == FindingKind::displaced;
  const Point2 target = nearest(*s);
  const auto answered = displaced ? answered_point(look, s->edge[0], s->edge[2]) : std::nullopt;
  const double distance = answered ? length(*answered) : length(target);
  if (!is_finite(distance)) return {};
  const double half_height = distance > 0 ? 2.2 * distance : 4, half_width = half_height * width / height;
  Drawing d({width / 2, height / 2}, width / 2 / half_width);
  const auto frame = window(half_width, half_height);
  const bool grid = half_height >= 2 && half_height <= 12;
  if (grid) {
    for (double k = -std::floor(half_width); k <= half_width; ++k)
      d.line({k, -half_height}, {k, half_height}, "grid");
    for (double k = -std::floor(half_height); k <= half_height; ++k)
      d.line({-half_width, k}, {half_width, k}, "grid");
  }
  std::vector<Point2> inner = {
      {-half_width, -half_height}, {half_width, -half_height}, {half_width, half_height}, {-half_width, half_height}};
  for (const HalfPlane& side : s->side) inner = clipped(inner, side);
  d.polygon(inner, "inner");
  for (unsigned k = 0; k < 3; ++k) {
    if (const auto whole = border_within(s->side[k], frame); !whole.empty()) d.line(whole[0], whole[1], "beyond");
    auto within = frame;
    within.push_back(s->side[(k + 1) % 3]);
    within.push_back(s->side[(k + 2) % 3]);
    const auto part = border_within(s->side[k], within);
    if (part.empty()) continue;
    d.line(part[0], part[1], "edge");
    const Point2 far = length(part[0]) > length(part[1]) ? part[0] : part[1],
                 near = length(part[0]) > length(part[1]) ? part[1] : part[0];
    d.text(0.75 * far + 0.25 * near, -18 * s->side[k].inward.x, s->side[k].inward.y > 0 ? 20 : -8,
           fmt::format("edge {}", edge_names[k]));
  }
  for (unsigned k = 0; k < 3; ++k)
    if (std::abs(s->corner[k].x) < half_width && std::abs(s->corner[k].y) < half_height)
      d.text(s->corner[k], s->corner[k].x > 0 ? 12 : -12, s->corner[k].y > 0 ? -8 : 18, corner_names[k], "corner");
  if (!inner.empty()) {
    Point2 middle;
    for (const Point2 p : inner) middle = middle + 1.0 / static_cast<double>(inner.size()) * p;
    const bool room =
        std::ranges::all_of(s->side, [&](const HalfPlane& h) { return h.over(middle) > 0.12 * half_height; });
    if (room && length(middle) > 0.2 * half_height) d.text(middle, 0, 5, "inside", "area");
  }
  const Point2 aim = answered ? *answered : target;
  if (distance > 0) {
    d.line({0, 0}, aim, "gap");
    if (std::abs(aim.y) > 0.4 * std::abs(aim.x))
      d.text(0.5 * aim, aim.x < 0 ? -46 : 46, 5, in_ulps(distance), "measure");
    else
      d.text(0.5 * aim, 0, aim.y > 0 ? 24 : -14, in_ulps(distance), "measure");
  }
  if (answered) {
    d.cross(*answered, "answered");
    d.text(*answered, 0, answered->y > 0 ? -12 : 20, "the tracer's point");
  }
  d.dot({0, 0}, "ray");
  d.text({0, 0}, std::abs(aim.y) > 0.4 * std::abs(aim.x) ? 0 : aim.x > 0 ? -34 : 34, aim.y > 0 ? 22 : -12, "the ray");
  d.scale_bar(in_ulps);
  const double magnified = look.longest_edge_ulps / half_width;
  std::string caption = "Seen along the ray, which is the dot";
  if (magnified > 10) caption += fmt::format(", and magnified {} times", short_number(magnified));
  const std::string part = row.kind == FindingKind::false_hit ? "outside" : "inside";
  if (answered)
    caption += fmt::format(". The u and v of the answer are those of a point {} beside it.", in_ulps(distance));
  else if (distance > 0)
    caption += fmt::format(". It passes {} {} the triangle.", in_ulps(distance), part);
  else
    caption += ". It meets the border exactly.";
  caption += beyond(row, look, distance);
  if (grid) caption += " The grid is one ulp wide.";
  return {d.take("The disagreement, seen along the ray"), caption};
}

std::optional<double> height_ulps(const Look& look, double t) {
  const auto h = height_above_plane(look.triangle, look.query, t);
  if (!h || !look.margins || !is_finite(*h / look.margins->ulp)) return std::nullopt;
  return *h / look.margins->ulp;
}

Picture from_the_side(const FindingRow& row, const Look& look) {
  if (!look.margins) return {};
  const int det = look.certificate.det.sign;
  const bool displaced = row.kind == FindingKind::displaced;
  const double t = displaced                                      ? (look.answer ? look.answer->t : HUGE_VAL)
                   : row.element == Element::t_max                ? look.query.ray.t_max
                   : det == 0 && !is_finite(look.query.ray.t_min) ? 0
                                                                  : look.query.ray.t_min;
  const auto above = height_ulps(look, t);
  if (!above) return {};
  const double h = det > 0 ? -*above : *above;  // so that the ray goes down
  const double half_height = h != 0 ? 2.2 * std::abs(h) : 4, half_width = half_height * width / height;
  Drawing d({width / 2, height / 2}, width / 2 / half_width);
  d.line({-half_width, 0}, {half_width, 0}, "edge");
  d.text({half_width, 0}, -60, -8, "the triangle");
  const double true_slope = std::tan(std::asin(std::min(1.0, look.margins->sine)));
  const double slope = det == 0 ? 0 : std::clamp(true_slope, 0.4, 3.0);
  const auto on_ray = [&](double y) { return Point2{det == 0 ? 0 : -y / slope, y}; };
  const Point2 point = det == 0 ? Point2{-half_width / 2, h} : on_ray(h);
  const bool is_end = row.element == Element::t_max, is_start = row.element == Element::t_min;
  const Point2 begin = on_ray(half_height), end = on_ray(-half_height);
  if (det == 0) {
    d.line({-half_width, h}, {half_width, h}, "path");
  } else {
    if (is_start || is_end) d.line(begin, end, "beyond");
    d.line(is_start ? point : begin, is_end ? point : end, "path");
  }
  d.line({point.x, 0}, point, "gap");
  d.text(0.5 * (point + Point2{point.x, 0}), point.x > 0 ? 50 : -50, 5, in_ulps(std::abs(h)), "measure");
  if (displaced)
    d.cross(point, "answered");
  else
    d.dot(point, "ray");
  d.text(point, 0, h > 0 ? -12 : 22,
         displaced  ? "the tracer's point"
         : is_start ? "the ray starts here"
         : is_end   ? "the ray ends here"
                    : "the ray");
  d.scale_bar(in_ulps);
  std::string caption = "Seen from the side, the triangle's plane edge-on; heights are to scale";
  if (det != 0 && slope != true_slope) caption += ", the angle is not";
  if (displaced)
    caption += fmt::format(". By its t the answer's point is {} off the plane.", in_ulps(std::abs(h)));
  else if (is_start || is_end)
    caption += fmt::format(". The range's {} is {} {} the plane.", is_start ? "start" : "end", in_ulps(std::abs(h)),
                           h > 0 ? "before" : "behind");
  else
    caption += fmt::format(". The ray runs beside the plane, {} away.", in_ulps(std::abs(h)));
  caption += beyond(row, look, std::abs(h));
  return {d.take("The disagreement, seen from the side"), caption};
}

}  // namespace

Picture whole_triangle(const FindingRow& row, const Look& look) {
  const auto longest = [&] {
    const auto first = seen_flat(look.triangle, look.query, 0);
    if (!first) return 0u;
    return static_cast<unsigned>(std::ranges::max_element(first->edge, {}, length) - first->edge.begin());
  };
  const unsigned base = longest();
  const auto outline = seen_flat(look.triangle, look.query, base);
  if (!outline) return {};
  const double unit = length(outline->edge[base]);
  std::vector<Point2>
      corners;  // in longest edges, from the base's start: differences of points far away would cancel
  const unsigned third = (base + 2) % 3;
  const Point2 base_edge = 1 / unit * outline->edge[base], up = 1 / unit * outline->edge[third];
  corners.resize(3);
  corners[(base + 1) % 3] = base_edge;
  corners[third] = -1.0 * up;
  const Point2 ray = -1 / unit * outline->corner[base];
  if (!finite(base_edge) || !finite(up) || !finite(ray)) return {};
  double left = std::min({0.0, corners[0].x, corners[1].x, corners[2].x});
  double right = std::max({0.0, corners[0].x, corners[1].x, corners[2].x});
  double top = std::max(corners[third].y, 1e-300), bottom = 0;
  const bool near = ray.x > left - 1 && ray.x < right + 1 && ray.y > bottom - 1 && ray.y < top + 1;
  const double tall = top;
  if (near) {
    left = std::min(left, ray.x), right = std::max(right, ray.x);
    bottom = std::min(bottom, ray.y), top = std::max(top, ray.y);
  }
  const double stretch = tall < 0.15 ? 0.4 / tall : 1;
  const bool stretched_away = stretch > 1 && (top - bottom) > 3 * tall;
  if (stretched_away) top = std::min(top, 2 * tall), bottom = std::max(bottom, -tall);
  const double scale = std::min((width - 80) / (right - left), (height - 90) / ((top - bottom) * stretch));
  const Point2 middle{(left + right) / 2, (top + bottom) / 2};
  Drawing d({width / 2 - scale * middle.x, height / 2 + scale * stretch * middle.y}, scale, stretch);
  d.polygon(corners, "inner outlined");
  if (row.element >= Element::ab && row.element <= Element::ca) {
    const unsigned k = static_cast<unsigned>(row.element) - 1;
    d.line(corners[k], corners[(k + 1) % 3], "violated");
  }
  for (unsigned k = 0; k < 3; ++k) d.text(corners[k], 0, k == third ? -9 : 20, corner_names[k], "corner");
  const bool shown = near && !(stretched_away && (ray.y > top || ray.y < bottom));
  std::string caption = "The triangle in its plane";
  if (shown) {
    if (row.kind == FindingKind::displaced && row.element != Element::plane) {
      if (const auto answered = answered_point(look, 1 / unit * outline->edge[0], 1 / unit * outline->edge[2])) {
        const Point2 p = ray + *answered;
        if (p.x > left - 0.1 && p.x < right + 0.1 && p.y > bottom - 0.1 && p.y < top + 0.1) d.cross(p, "answered");
      }
    }
    d.dot(ray, "ray");
    caption += "; the dot is where the ray meets that plane";
  } else {
    const Point2 away = ray + -1.0 * middle;
    const Point2 to = d.at({middle.x + away.x / length(away), middle.y + away.y / length(away)});
    const Point2 from = d.at(middle), step = Point2{to.x - from.x, to.y - from.y};
    const double most = std::min((width / 2 - 14) / std::max(1e-9, std::abs(step.x)),
                                 (height / 2 - 14) / std::max(1e-9, std::abs(step.y)));
    d.add("<line class=\"path arrow\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>",
          from.x + 0.6 * most * step.x, from.y + 0.6 * most * step.y, from.x + most * step.x, from.y + most * step.y);
    caption += fmt::format("; the ray meets that plane beyond the picture, {} longest edges away",
                           short_number(length(away)));
  }
  caption +=
      stretch > 1 ? fmt::format(". Drawn {} times as high as it is: it is narrow.", short_number(stretch)) : ".";
  return {d.take("The whole triangle in its plane"), caption};
}

Picture disagreement(const FindingRow& row, const Look& look) {
  if (row.kind == FindingKind::death || row.kind == FindingKind::not_finite) return {};
  const bool at_plane =
      row.element == Element::plane || row.element == Element::t_min || row.element == Element::t_max;
  return at_plane ? from_the_side(row, look) : from_along_the_ray(row, look);
}

Picture along_the_ray(std::span<const Triangle> triangles, const Query& query, const BagTruth& truth) {
  const auto& [o, direction, t_min, t_max] = query.ray;
  const double long_axis = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  const Vec3 d{direction.x / long_axis, direction.y / long_axis, direction.z / long_axis};
  const auto times = [](const Vec3& p, const Vec3& q) {
    return Vec3{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
  };
  const auto along = [](const Vec3& p, const Vec3& q) { return p.x * q.x + p.y * q.y + p.z * q.z; };
  const auto unit = [&](const Vec3& p) {
    const double l = std::sqrt(along(p, p));
    return Vec3{p.x / l, p.y / l, p.z / l};
  };
  const Vec3 right = unit(std::abs(d.y) < 0.9 ? times(d, {0, 1, 0}) : times(d, {1, 0, 0}));
  const Vec3 up = unit(times(right, d));
  std::vector<std::vector<Point2>> seen;
  Point2 low{0, 0}, high{0, 0};
  for (const Triangle& t : triangles) {
    seen.emplace_back();
    for (const Vec3& v : {t.a, t.b, t.c}) {
      const Vec3 from{v.x - o.x, v.y - o.y, v.z - o.z};
      const Point2 p{along(from, right), along(from, up)};
      if (!finite(p)) return {};
      seen.back().push_back(p);
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  const double scale = std::min((width - 60) / (high.x - low.x), (height - 60) / (high.y - low.y));
  if (!is_finite(scale) || !(scale > 0)) return {};
  const Point2 middle = 0.5 * (low + high);
  Drawing drawing({width / 2 - scale * middle.x, height / 2 + scale * middle.y}, scale);
  for (std::size_t i = 0; i < truth.nearest(); ++i) drawing.polygon(seen[truth.hits[i].triangle], "inner");
  for (const std::vector<Point2>& corners : seen) drawing.polygon(corners, "hollow");
  drawing.dot({0, 0}, "ray");
  constexpr std::size_t most_names = 12;
  if (seen.size() <= most_names)
    for (std::size_t i = 0; i < seen.size(); ++i)
      drawing.text(1.0 / 3 * (seen[i][0] + seen[i][1] + seen[i][2]), 0, 4, std::to_string(i), "corner");
  return {drawing.take("The triangles, seen along the ray"),
          fmt::format("The triangles, seen along the ray, which is the dot.{}",
                      truth.hits.empty() ? "" : " Filled is what it crosses first.")};
}

}  // namespace plumbline
