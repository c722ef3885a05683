#include "case/case_json.h"

#include <array>
#include <limits>
#include <optional>

namespace plumbline {
namespace {

template <class Elements, class Append>
void append_array(std::string& out, const Elements& elements, Append append) {
  out += '[';
  bool first = true;
  for (const auto& element : elements) {
    if (!first) out += ',';
    first = false;
    append(out, element);
  }
  out += ']';
}

void append_vector(std::string& out, const Vec3& p) {
  append_array(out, std::array{p.x, p.y, p.z}, append_json_number);
}

void append_triangle(std::string& out, const Triangle& t) {
  append_array(out, std::array{t.a, t.b, t.c}, append_vector);
}

}  // namespace

void append_json(std::string& out, const Case& what) {
  JsonObject object(out);
  object.text("id", what.id);
  add_members(object, what);
  object.end_line();
}

void add_members(JsonObject& object, const Case& what) {
  if (what.precision != Precision::binary64) object.text("precision", name(what.precision));
  const Bag& bag = what.bag;
  if (bag.triangles.size() == 1) {
    append_triangle(object.member("triangle"), bag.triangles.front());
  } else {
    append_array(object.member("triangles"), bag.triangles, append_triangle);
  }
  append_vector(object.member("origin"), what.ray.origin);
  append_vector(object.member("direction"), what.ray.direction);
  object.number("t_min", what.ray.t_min);
  const bool endless = what.ray.t_max == std::numeric_limits<double>::infinity();
  object.number("t_max", endless ? std::nullopt : std::optional(what.ray.t_max));
  if (bag != Bag{.triangles = bag.triangles}) {
    object.text("mode", name(bag.mode));
    if (bag.mode == BagMode::plate) {
      object.number("thickness", bag.thickness);
      object.text("position", name(bag.position));
      object.boolean("cosine", bag.cosine);
    }
    object.text("orientation", name(bag.orientation));
  }
  if (what.aim) {
    object.text("target", name(what.aim->target));
    object.number("tolerance", what.aim->tolerance);
    object.number("standoff", what.aim->standoff);
    object.text("wish", name(what.aim->wish));
  }
}

void add_members(JsonObject& object, const Answer& answer) {
  const bool hit = answer.outcome == Outcome::hit;
  const auto given = [hit](bool has, double x) { return hit && has ? std::optional(x) : std::nullopt; };
  const bool fault = answer.outcome == Outcome::fault;
  object.boolean("hit", fault ? std::nullopt : std::optional(hit));
  if (fault) object.boolean("fault", true);
  object.number("t", given(answer.has_t, answer.t));
  object.number("u", given(answer.has_uv, answer.u));
  object.number("v", given(answer.has_uv, answer.v));
  object.number("in", given(answer.has_segment, answer.in));
  object.number("out", given(answer.has_segment, answer.out));
  if (answer.triangle != 0) object.number("triangle_index", answer.triangle);
}

}  // namespace plumbline
