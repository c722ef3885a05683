#include "float_tracer/adapters/gts.h"

#include <gts.h>

#include <algorithm>
#include <limits>

#include "case/finite.h"
#include "float_tracer/adapters/nearest.h"
#include "float_tracer/adapters/prepared_triangles.h"
#include "float_tracer/adapters/segment.h"

namespace plumbline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Destroy {
  void operator()(void* object) const { gts_object_destroy(static_cast<GtsObject*>(object)); }
};
template <class T>
using Owned = std::unique_ptr<T, Destroy>;

GtsVertex* vertex(const Vec3& v) { return gts_vertex_new(gts_vertex_class(), v.x, v.y, v.z); }

// Destroying it destroys its edges and vertices.
Owned<GtsTriangle> build(const Triangle& t) {
  GtsVertex *const a = vertex(t.a), *const b = vertex(t.b), *const c = vertex(t.c);
  const auto edge = [](GtsVertex* p, GtsVertex* q) { return gts_edge_new(gts_edge_class(), p, q); };
  return Owned<GtsTriangle>(gts_triangle_new(gts_triangle_class(), edge(a, b), edge(b, c), edge(c, a)));
}

void move(GtsVertex* v, const Vec3& to) { gts_point_set(&v->p, to.x, to.y, to.z); }

// No t is in it: a miss whatever is met, and no segment has such a range.
bool has_empty_range(const Ray& ray) {
  return ray.t_min > ray.t_max || ray.t_min == infinity || ray.t_max == -infinity;
}

class PreparedGts final : public PreparedBag {
 public:
  explicit PreparedGts(const Bag& bag)
      : largest_(largest_coordinate(bag)),
        takes_(std::ranges::all_of(bag.triangles, [](const Triangle& t) { return is_finite(t); })),
        segment_(gts_segment_new(gts_segment_class(), vertex({}), vertex({}))) {
    if (!takes_) return;
    triangles_.reserve(bag.triangles.size());
    for (const Triangle& t : bag.triangles) triangles_.push_back(build(t));
  }

  Query asked(const Ray& ray) override {
    const auto segment = segment_for(ray);
    return segment ? segment->query : ray;
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = answer(rays[i]);
  }

  Answer answer(const Ray& ray) {
    if (takes_ && has_empty_range(ray)) return {};
    const auto segment = segment_for(ray);
    if (!segment) return {.outcome = Outcome::fault};
    move(segment_->v1, segment->from);
    move(segment_->v2, segment->to);
    return nearest(triangles_, [&](const Owned<GtsTriangle>& triangle) -> Answer {
      GtsPoint* const p = gts_segment_triangle_intersection(segment_.get(), triangle.get(), TRUE, gts_point_class());
      if (!p) return {};
      const double t = parameter_of({p->x, p->y, p->z}, segment->query.ray);
      if (is_new(p, triangle.get())) gts_object_destroy(&p->object);
      return {.outcome = Outcome::hit, .has_t = true, .t = t};
    });
  }

  std::optional<Segment> segment_for(const Ray& ray) const {
    return takes_ ? segment_of(ray, largest_, Precision::binary64) : std::nullopt;
  }

  bool is_new(const GtsPoint* p, GtsTriangle* triangle) const {
    GtsVertex *a, *b, *c;
    gts_triangle_vertices(triangle, &a, &b, &c);
    return p != &a->p && p != &b->p && p != &c->p && p != &segment_->v1->p && p != &segment_->v2->p;
  }

  double largest_;
  bool takes_;
  std::vector<Owned<GtsTriangle>> triangles_;
  Owned<GtsSegment> segment_;  // moved from ray to ray
};

std::string version() {
  return std::to_string(gts_major_version) + "." + std::to_string(gts_minor_version) + "." +
         std::to_string(gts_micro_version);
}

class GtsTracer final : public Tracer {
 public:
  GtsTracer()
      : Tracer({.name = "gts_segment_f64",
                .summary = "GTS: adaptive exact predicates, asked with a segment",
                .source = "gts_segment_triangle_intersection",
                .package = "libgts-dev " + version(),
                .contract = {.degenerate = TouchRule::unspecified},
                .own_queries = true}) {
    // Each class is set up by its first use, without a lock: so here, before there are threads.
    gts_point_class(), gts_vertex_class(), gts_segment_class(), gts_edge_class(), gts_triangle_class();
  }

  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    return std::make_unique<PreparedGts>(bag);
  }
};

}  // namespace

std::vector<std::unique_ptr<Tracer>> gts_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  list.push_back(std::make_unique<GtsTracer>());
  return list;
}

}  // namespace plumbline
