#include "float_tracer/brlcad/bot_hlbvh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "float_tracer/brlcad/bot_tracer.h"
#include "float_tracer/brlcad/hierarchy.h"
#include "float_tracer/brlcad/shot.h"
#include "float_tracer/brlcad/walk.h"

namespace plumbline {
namespace brlcad {
namespace {

// A ray along an axis in the upper face of a box leaves it at 0 on the other axes, before it has entered on its own:
// culled. In the lower face it enters at 0 and stays. The boxes of thin leaves inside the object have such faces as
// well.
class BoxTest {
 public:
  explicit BoxTest(const Entry& entry)
      : origin_(entry.box_near < 0 ? entry.point + entry.box_near * entry.direction : entry.point) {
    for (int i = 0; i < 3; ++i) inverse_[i] = 1 / (entry.direction[i] + std::copysign(1e-73, entry.direction[i]));
  }

  bool operator()(const Box& box) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double near = -infinity, far = infinity;
    for (int i = 0; i < 3; ++i) {
      const double to_low = (box.low[i] - origin_[i]) * inverse_[i], to_high = (box.high[i] - origin_[i]) * inverse_[i];
      near = std::max(near, std::min(to_low, to_high));
      far = std::min(far, std::max(to_low, to_high));
    }
    return !(far < -1e-77 || near > far);
  }

 private:
  Vector origin_, inverse_{};
};

// The margin counts in full along two edges, and less along the third the steeper the ray and the larger the triangle.
template <class Why>
std::optional<double> intersect(const Face& face, double margin, const Vector& origin, const Vector& direction,
                                Why why) {
  const Vector normal = std::sqrt(dot(face.cross, face.cross)) * face.unit_normal;  // rounded again: not face.cross
  const double slope = dot(normal, direction), size = std::abs(slope);
  if (size < least_slope) return missed_by(Rejection::parallel, why);
  const Vector to_a = face.a - origin, x = cross(to_a, direction);
  const double along_ab = dot(face.ab, x), beta = slope > 0 ? -along_ab : along_ab;
  const double along_ac = dot(face.ac, x), gamma = slope < 0 ? -along_ac : along_ac;
  const double most = size + margin * (1 / (1 + size));
  if (!(beta >= -margin && gamma >= -margin && beta + gamma <= most))
    return missed_by(
        [=] { return !(beta >= -margin)    ? Rejection::ab
                     : !(gamma >= -margin) ? Rejection::ca
                                           : Rejection::bc; }, why);
  return dot(to_a, normal) / slope;
}

// By insertion; hits at one distance turn their order round.
void sort(std::vector<Hit>& hits) {
  for (std::size_t i = 1; i < hits.size(); ++i) {
    const Hit hit = hits[i];
    std::size_t j = i;
    for (; j > 0 && !(hits[j - 1].t < hit.t); --j) hits[j] = hits[j - 1];
    hits[j] = hit;
  }
}

class Hlbvh {
 public:
  static TracerInfo info() {
    return {.name = "brlcad_bot_hlbvh",
            .summary = "BRL-CAD's BoT since 7.42: the same ray walk, box tests without a margin, another triangle test",
            .source = "BRL-CAD 7.42 to 7.44, librt, with the ray walk of 7.24.2",
            .contract = {.range = RangeRule::ray, .t_min = EndRule::unspecified},
            .constants = {distance_tolerance, least_slope}};
  }

  explicit Hlbvh(const Bag& bag) : solid_(prepare_solid(bag)), possible_(finite_sides(box_of(bag.triangles))) {
    if (empty() || !possible_) return;
    std::vector<Triangle> left;
    for (const Face& face : solid_.faces) left.push_back(bag.triangles[face.index]);
    hierarchy_.emplace(left);
    model_box_ = model_box_of(thickened(hierarchy_->box()));
    if (solid_.oriented()) margin_ = std::numeric_limits<double>::epsilon() * half_longest_side(hierarchy_->box()) * 10;
  }

  bool possible() const { return possible_; }
  bool empty() const { return solid_.faces.empty(); }

  template <class Why>
  bool shoot(const Vector& origin, const Vector& direction, std::vector<Passage>& pieces, Why why) {
    const std::optional<Entry> entry = enter(model_box_, origin, direction, why);
    if (!entry) return true;
    shot_.clear();
    missed_by(Rejection::box, why);  // unless a triangle is tested
    hierarchy_->for_each(BoxTest(*entry), [&](std::uint32_t i) {
      const Face& face = solid_.faces[i];
      if (const auto t = intersect(face, margin_, entry->point, entry->direction, why))
        shot_.hits.push_back({*t, solid_.slope(face, entry->direction), face.index});
    });
    if (shot_.hits.empty()) return true;
    missed_by(Rejection::none, why);
    sort(shot_.hits);
    shot_.gather(solid_, entry->moved);
    shot_.weave(pieces, why);
    return true;
  }

 private:
  Solid solid_;
  bool possible_;
  std::optional<Hierarchy> hierarchy_;  // over the faces that are left
  Box model_box_{};
  double margin_ = 0;
  Shot shot_;
};

}  // namespace
}  // namespace brlcad

std::unique_ptr<Tracer> brlcad_bot_hlbvh() { return std::make_unique<brlcad::BotTracer<brlcad::Hlbvh>>(); }

}  // namespace plumbline
