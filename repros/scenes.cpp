// The triangles and the ray for programs that show or load meshes. Numbers are the shortest decimals that read back
// as the same doubles; the ray, which no mesh format has, is told exactly in a comment, and drawn as far as past the
// triangles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "case/finite.h"
#include "case/input_error.h"
#include "case/real_text.h"
#include "float_tracer/adapters/segment.h"
#include "oracle/bag/explain_bag.h"
#include "oracle/explain.h"
#include "repros/forms.h"
#include "repros/text.h"

namespace plumbline {
namespace {

void require_finite(const Case& what) {
  const auto finite = [](const Triangle& t) { return is_finite(t.a) && is_finite(t.b) && is_finite(t.c); };
  if (std::ranges::all_of(what.bag.triangles, finite) && is_finite(what.ray.origin) && is_finite(what.ray.direction))
    return;
  throw InputError(
      fmt::format("case '{}' has a coordinate that is not finite, which no scene holds; export another", what.id));
}

std::string words(const Vec3& v) { return decimals(v, " "); }

// The far end of what is drawn of the ray; no value where it would overflow, or the direction is zero.
std::optional<Vec3> drawn_to(const Case& what) {
  const auto& [o, d, t_min, t_max] = what.ray;
  const double k = reach(o, d, largest_coordinate(what.bag));
  const Vec3 end{o.x + k * d.x, o.y + k * d.y, o.z + k * d.z};
  return is_finite(end) ? std::optional(end) : std::nullopt;
}

// As lines of a comment.
std::string told(const Case& what) {
  std::string text = fmt::format("case {}\n", harmless(what.id));
  for (const std::string& line : what.provenance) text += harmless(line) + "\n";
  text += fmt::format("ray from {} along {}, t from {} to {}\n", words(what.ray.origin), words(what.ray.direction),
                      shortest_decimal(what.ray.t_min), shortest_decimal(what.ray.t_max));
  const std::vector<Triangle>& triangles = what.bag.triangles;
  text += triangles.size() == 1 ? explain(triangles.front(), what.ray)
                                : explain_bag(triangles, what.ray, bag_truth(triangles, what.ray));
  return text + "Read the numbers as doubles: each decimal is one exactly. The end of the ray's line is rounded.\n";
}

}  // namespace

std::string obj(const Case& what) {
  require_finite(what);
  std::string text = commented(told(what), "# ") + "o triangles\n";
  for (const Triangle& t : what.bag.triangles)
    for (const Vec3& v : {t.a, t.b, t.c}) text += fmt::format("v {}\n", words(v));
  const std::size_t count = what.bag.triangles.size();
  for (std::size_t i = 0; i < count; ++i) text += fmt::format("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
  if (const auto end = drawn_to(what))
    text += fmt::format("o ray\nv {}\nv {}\nl {} {}\n", words(what.ray.origin), words(*end), 3 * count + 1,
                        3 * count + 2);
  return text;
}

std::string ply(const Case& what) {
  require_finite(what);
  const auto end = drawn_to(what);
  const std::size_t count = what.bag.triangles.size();
  std::string text = "ply\nformat ascii 1.0\n" + commented(told(what), "comment ");
  text += fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
                      3 * count + (end ? 2 : 0));
  text += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", count);
  if (end) text += "element edge 1\nproperty int vertex1\nproperty int vertex2\n";
  text += "end_header\n";
  for (const Triangle& t : what.bag.triangles)
    for (const Vec3& v : {t.a, t.b, t.c}) text += words(v) + "\n";
  if (end) text += words(what.ray.origin) + "\n" + words(*end) + "\n";
  for (std::size_t i = 0; i < count; ++i) text += fmt::format("3 {} {} {}\n", 3 * i, 3 * i + 1, 3 * i + 2);
  if (end) text += fmt::format("{} {}\n", 3 * count, 3 * count + 1);
  return text;
}

// What BRL-CAD's asc2g reads: a Tcl script. `fm` is a bit for each face: whether its plate is appended.
std::string asc(const Case& what) {
  require_finite(what);
  const Bag& bag = what.bag;
  const std::size_t count = bag.triangles.size();
  const bool plate = bag.mode == BagMode::plate;
  std::string vertices, faces, thicknesses;
  for (const Triangle& t : bag.triangles)
    for (const Vec3& v : {t.a, t.b, t.c}) vertices += fmt::format(" {{ {} }}", words(v));
  for (std::size_t i = 0; i < count; ++i) {
    faces += fmt::format(" {{ {} {} {} }}", 3 * i, 3 * i + 1, 3 * i + 2);
    thicknesses += " " + shortest_decimal(bag.thickness);
  }
  std::string text =
      commented(told(what) + fmt::format("\nasc2g scene.asc scene.g; nirt -e 'xyz {}; dir {}; s; q' scene.g bag\n",
                                         words(what.ray.origin), words(what.ray.direction)),
                "# ");
  text += "title {triangles under a ray}\nunits mm\n";
  text += fmt::format("put bag bot mode {} orient {} V {{{} }} F {{{} }}",
                      bag.mode == BagMode::surface ? "surf"
                      : bag.mode == BagMode::solid ? "volume"
                      : bag.cosine                 ? "plate"
                                                   : "plate_nocos",
                      bag.orientation == Orientation::none  ? "no"
                      : bag.orientation == Orientation::ccw ? "rh"
                                                            : "lh",
                      vertices, faces);
  if (plate) {
    std::string bits((count + 7) / 8 * 2, bag.position == PlatePosition::appended ? 'f' : '0');
    text += fmt::format(" T {{{} }} fm {}", thicknesses, bits);
  }
  return text + "\n";
}

}  // namespace plumbline
