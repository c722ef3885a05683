#include "mesh/mesh_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "case/float_bits.h"
#include "case/json_object.h"
#include "oracle/margins.h"

namespace plumbline {
namespace {

void count(Flaw& flaw, std::uint32_t triangle) {
  flaw.triangle = flaw.count == 0 ? triangle : std::min(flaw.triangle, triangle);
  ++flaw.count;
}

double magnitude(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// Margins know nothing of a triangle without area, nor of one in whose plane the ray runs and meets it. Rays along
// all three axes can't run in one plane: so where none has an answer, the triangle has no area.
std::optional<Margins> margins_of(const Triangle& triangle, Precision precision) {
  for (const Vec3& direction : {Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{1, 0, 0}})
    if (auto found = margins(triangle, Ray{{0, 0, 0}, direction}, precision)) return found;
  return std::nullopt;
}

// Lengths in ulps of the mesh's largest coordinate.
class Ruler {
 public:
  explicit Ruler(const MeshReport& of) {
    const double largest = of.largest_coordinate;
    exponent_ =
        of.precision == Precision::binary32 ? ulp_exponent(static_cast<float>(largest)) : ulp_exponent(largest);
    if (largest >= 0x1p1023) half_ = 0.5;  // a difference of two such may overflow
  }

  double distance(const Vec3& a, const Vec3& b) const {
    const Vec3 d = {b.x * half_ - a.x * half_, b.y * half_ - a.y * half_, b.z * half_ - a.z * half_};
    const double m = magnitude(d);
    if (m == 0) return 0;
    const Vec3 unit = {d.x / m, d.y / m, d.z / m};  // so that no square under- or overflows
    const double root = std::sqrt(unit.x * unit.x + unit.y * unit.y + unit.z * unit.z);
    return std::ldexp(m, half_ == 1 ? -exponent_ : 1 - exponent_) * root;
  }

  double altitude(const Triangle& t, const Margins& m) const {
    const double largest = std::max({magnitude(t.a), magnitude(t.b), magnitude(t.c)});  // the ray begins at 0
    return std::ldexp(largest, -exponent_) * m.size * m.altitude;
  }

 private:
  int exponent_;
  double half_ = 1;
};

void keep_less(std::optional<LeastLength>& least, double ulps, std::uint32_t triangle) {
  if (!least || ulps < least->ulps) least = {ulps, triangle};
}

void look_at_triangles(const Mesh& mesh, MeshReport& report) {
  const Ruler ruler(report);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle t = triangle_at(mesh, i);
    const auto m = margins_of(t, mesh.precision);
    if (!m) {
      count(report.degenerate, i);
      continue;
    }
    keep_less(report.altitude, ruler.altitude(t, *m), i);
    keep_less(report.edge, std::min({ruler.distance(t.a, t.b), ruler.distance(t.b, t.c), ruler.distance(t.c, t.a)}),
              i);
  }
}

void look_for_duplicates(const Mesh& mesh, MeshReport& report) {
  std::vector<std::pair<Corners, std::uint32_t>> sorted;  // with whose corners they are
  sorted.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    sorted.emplace_back(mesh.triangles[i], i);
    std::ranges::sort(sorted.back().first);
  }
  std::ranges::sort(sorted);
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (sorted[k].first == sorted[k - 1].first) count(report.duplicate, sorted[k].second);
}

void look_at_edges(const Mesh& mesh, MeshReport& report) {
  struct Edge {
    std::uint32_t low, high, triangle;
    bool rising;  // the triangle runs from low to high
    auto operator<=>(const Edge&) const = default;
    bool beside(const Edge& other) const { return low == other.low && high == other.high; }
  };
  std::vector<Edge> sorted;
  sorted.reserve(3 * mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = mesh.triangles[i];
    if (a == b || b == c || c == a) continue;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      sorted.push_back({std::min(from, to), std::max(from, to), i, from < to});
  }
  std::ranges::sort(sorted);
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    while (end < sorted.size() && sorted[end].beside(sorted[begin])) ++end;
    const Edge& first = sorted[begin];
    if (end - begin == 1) count(report.open, first.triangle);
    if (end - begin > 2) count(report.non_manifold, first.triangle);
    if (end - begin == 2 && first.rising == sorted[begin + 1].rising) count(report.misoriented, first.triangle);
  }
  report.closed = !sorted.empty() && report.open.count + report.non_manifold.count + report.misoriented.count == 0;
}

// Vertices that hang together have the same root.
class Pieces {
 public:
  explicit Pieces(std::size_t vertices) : parent_(vertices) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t root(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(std::uint32_t v, std::uint32_t w) {
    const auto [low, high] = std::minmax({root(v), root(w)});
    parent_[high] = low;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

void look_at_pieces(const Mesh& mesh, MeshReport& report) {
  Pieces pieces(mesh.vertices.size());
  std::vector<bool> used(mesh.vertices.size());
  for (const Corners& corners : mesh.triangles)
    for (const std::uint32_t v : corners) {
      used[v] = true;
      pieces.join(corners[0], v);
    }
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!used[v]) ++report.isolated_vertices;
    if (used[v] && pieces.root(v) == v) ++report.pieces;
  }
}

std::string text_of(std::string_view what, const Flaw& flaw) {
  return flaw.count == 0 ? fmt::format("{:24}0\n", what)
                         : fmt::format("{:24}{}, the first at triangle {}\n", what, flaw.count, flaw.triangle);
}

std::string text_of(std::string_view what, const std::optional<LeastLength>& least) {
  return least ? fmt::format("{:24}{:.3g} ulps, of triangle {}\n", what, least->ulps, least->triangle) : "";
}

void append_flaw(std::string& out, const Flaw& flaw) {
  JsonObject object(out);
  object.number("count", static_cast<double>(flaw.count));
  object.number("triangle", flaw.count == 0 ? std::nullopt : std::optional<double>(flaw.triangle));
  object.end();
}

void append_length(std::string& out, const std::optional<LeastLength>& least) {
  if (!least) {
    out += "null";
    return;
  }
  JsonObject object(out);
  object.number("ulps", least->ulps);
  object.number("triangle", least->triangle);
  object.end();
}

}  // namespace

MeshReport report(const Mesh& mesh) {
  MeshReport report;
  report.triangles = mesh.triangles.size();
  report.vertices = mesh.vertices.size();
  report.precision = mesh.precision;
  for (const Vec3& v : mesh.vertices) report.largest_coordinate = std::max(report.largest_coordinate, magnitude(v));
  look_at_triangles(mesh, report);
  look_for_duplicates(mesh, report);
  look_at_edges(mesh, report);
  look_at_pieces(mesh, report);
  return report;
}

std::string to_text(const MeshReport& r) {
  std::string text = fmt::format("{:24}{}\n{:24}{}\n{:24}{}\n", "triangles", r.triangles, "vertices", r.vertices,
                                 "coordinates", name(r.precision));
  text += fmt::format("{:24}{}\n{:24}{}\n{:24}{}\n", "largest coordinate", r.largest_coordinate, "pieces", r.pieces,
                      "isolated vertices", r.isolated_vertices);
  text += text_of("degenerate triangles", r.degenerate) + text_of("duplicate triangles", r.duplicate);
  text += text_of("open edges", r.open) + text_of("non-manifold edges", r.non_manifold);
  text += text_of("misoriented edges", r.misoriented);
  text += fmt::format("{:24}{}\n", "closed", r.closed ? "yes" : "no");
  return text + text_of("least edge", r.edge) + text_of("least altitude", r.altitude);
}

std::string to_json(const MeshReport& r) {
  std::string out;
  JsonObject object(out);
  object.number("triangles", static_cast<double>(r.triangles));
  object.number("vertices", static_cast<double>(r.vertices));
  object.text("precision", name(r.precision));
  object.number("largest_coordinate", r.largest_coordinate);
  object.number("pieces", static_cast<double>(r.pieces));
  object.number("isolated_vertices", static_cast<double>(r.isolated_vertices));
  append_flaw(object.member("degenerate_triangles"), r.degenerate);
  append_flaw(object.member("duplicate_triangles"), r.duplicate);
  append_flaw(object.member("open_edges"), r.open);
  append_flaw(object.member("non_manifold_edges"), r.non_manifold);
  append_flaw(object.member("misoriented_edges"), r.misoriented);
  object.boolean("closed", r.closed);
  append_length(object.member("least_edge"), r.edge);
  append_length(object.member("least_altitude"), r.altitude);
  object.end_line();
  return out;
}

}  // namespace plumbline
