#include "float_tracer/brlcad/bot_classic.h"

#include <cmath>
#include <utility>

#include "float_tracer/brlcad/bot_tracer.h"
#include "float_tracer/brlcad/cells.h"
#include "float_tracer/brlcad/shot.h"
#include "float_tracer/brlcad/walk.h"

namespace plumbline {
namespace brlcad {
namespace {

// Without a margin the edges belong to the triangle, and to its neighbour. The normal isn't of unit length, so what
// counts as parallel depends on the area; in pieces the unit normal is asked. A NaN, where huge numbers overflow,
// passes every comparison.
template <class Why>
std::optional<double> intersect(const Face& face, double margin, bool in_pieces, const Vector& origin,
                                const Vector& direction, Why why) {
  const double slope = dot(face.cross, direction), size = std::abs(slope);
  if ((in_pieces ? std::abs(dot(face.unit_normal, direction)) : size) < least_slope)
    return missed_by(Rejection::parallel, why);
  const double least = -margin, most = margin + size;
  const Vector to_a = face.a - origin, x = cross(to_a, direction);
  const double along_ac = dot(face.ac, x), alpha = slope < 0 ? -along_ac : along_ac;
  if (alpha < least || alpha > most)
    return missed_by([=] { return alpha < least ? Rejection::ca : Rejection::bc; }, why);
  const double along_ab = dot(face.ab, x), beta = slope > 0 ? -along_ab : along_ab;
  if (beta < least || beta > most) return missed_by([=] { return beta < least ? Rejection::ab : Rejection::bc; }, why);
  if (alpha + beta > most) return missed_by(Rejection::bc, why);
  return dot(to_a, face.cross) / slope;
}

// Exchanges what isn't in order, each with all behind it: not stable, and hits at one distance keep that order.
void sort(std::vector<Hit>& hits) {
  for (std::size_t i = 0; i < hits.size(); ++i)
    for (std::size_t j = i + 1; j < hits.size(); ++j)
      if (!(hits[i].t <= hits[j].t)) std::swap(hits[i], hits[j]);
}

constexpr std::string_view source = "BRL-CAD 7.22 to 7.40.2, librt; equal bit for bit to recordings of 7.24.2";

// A solid, its box, and what is hit of it.
class Target {
 public:
  explicit Target(const Bag& bag)
      : solid_(prepare_solid(bag)),
        pieces_(bag.triangles.size() > most_faces_in_one ? piece_boxes(solid_) : std::vector<Box>()) {
    Box box = empty_box();
    for (const Box& piece : pieces_) add(box, piece);
    box_ = thickened(pieces_.empty() ? box_of(bag.triangles) : box);
    margin_ = solid_.oriented() ? half_longest_side(box_) / 1e7 : 0;
  }

  bool empty() const { return solid_.faces.empty(); }
  const Solid& solid() const { return solid_; }
  const Box& box() const { return box_; }
  std::span<const Box> pieces() const { return pieces_; }

  // The shot function of a BoT in one piece: faces from the last to the first.
  template <class Why>
  void hit_all(const Vector& origin, const Vector& direction, std::vector<Hit>& hits, Why why) const {
    for (std::size_t i = solid_.faces.size(); i-- > 0;) hit(solid_.faces[i], false, origin, direction, 0, hits, why);
  }

  // That of some pieces, from the last to the first, of which none is shot at twice; at the hits of those before, as
  // well. The way of the moved origin is added at once.
  void hit_pieces(std::span<const std::uint32_t> pieces, const CellWalk& walk, std::vector<bool>& done,
                  std::vector<Hit>& hits) const {
    for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece) {
      if (done[*piece]) continue;
      done[*piece] = true;
      const std::size_t begin = *piece * faces_in_piece;
      const std::size_t end = std::min(begin + faces_in_piece, solid_.faces.size());
      for (std::size_t i = begin; i < end; ++i)
        hit(solid_.faces[i], true, walk.point(), walk.line().direction, walk.moved(), hits, Unasked());
    }
  }

 private:
  template <class Why>
  void hit(const Face& face, bool in_pieces, const Vector& origin, const Vector& direction, double moved,
           std::vector<Hit>& hits, Why why) const {
    if (const auto t = intersect(face, margin_, in_pieces, origin, direction, why))
      hits.push_back({in_pieces ? *t + moved : *t, solid_.slope(face, direction), face.index});
  }

  Solid solid_;
  std::vector<Box> pieces_;
  Box box_{};
  double margin_ = 0;
};

class Classic {
 public:
  static TracerInfo info() {
    return {.name = "brlcad_bot_classic",
            .summary = "BRL-CAD's BoT up to 7.40: ray walk with the 0.0005 mm entry nudge, then the triangle test",
            .source = std::string(source),
            .contract = {.range = RangeRule::ray, .t_min = EndRule::unspecified},
            .constants = {distance_tolerance, least_slope}};
  }

  explicit Classic(const Bag& bag) : target_(bag), model_box_(model_box_of(target_.box())) {
    if (!target_.pieces().empty() && possible()) cells_.emplace(model_box_, target_.pieces());
  }

  // In a single piece, left of more than 32 faces, librt shoots at what it never made, and dies of it.
  bool possible() const { return finite_sides(target_.box()) && target_.pieces().size() != 1; }
  bool empty() const { return target_.empty(); }

  template <class Why>
  bool shoot(const Vector& origin, const Vector& direction, std::vector<Passage>& pieces, Why why) {
    shot_.clear();
    if (!cells_) {
      if (walk_one_cell(origin, direction, why)) shot_.weave(pieces, why);
      return true;
    }
    CellWalk walk(*cells_, target_.box(), origin, direction);
    if (walk_cells(walk)) shot_.weave(pieces, why);
    return !walk.stuck();
  }

 private:
  // Whether anything was hit.
  template <class Why>
  bool walk_one_cell(const Vector& origin, const Vector& direction, Why why) {
    const std::optional<Entry> entry = enter(model_box_, origin, direction, why);
    if (!entry) return false;
    target_.hit_all(entry->point, entry->direction, shot_.hits, why);
    if (shot_.hits.empty()) return false;
    gather(entry->moved);
    return true;
  }

  // Hits are gathered until the ray has left the solid's box. Those of a plate become passages in every cell anew, and
  // once more at the end; of equal ones the weaving keeps one.
  bool walk_cells(CellWalk& walk) {
    const Cell* cell = walk.next();
    if (!cell) return false;
    const auto way = slab_test(target_.box(), walk.point(), walk.line().inverse);
    if (!way) return false;
    const double left = way->far + walk.moved();
    done_.assign(target_.pieces().size(), false);
    for (; cell; cell = walk.next()) {
      target_.hit_pieces(cell->pieces, walk, done_, shot_.hits);
      if (target_.solid().mode == BagMode::plate) gather(0);
      if (walk.end() > left && !shot_.hits.empty()) break;
    }
    if (shot_.hits.empty()) return false;
    gather(0);
    return true;
  }

  void gather(double moved) {
    sort(shot_.hits);
    shot_.gather(target_.solid(), moved);
  }

  Target target_;
  Box model_box_;
  std::optional<Cells> cells_;
  std::vector<bool> done_;  // which pieces were shot at
  Shot shot_;
};

class ClassicKernel {
 public:
  static TracerInfo info() {
    return {.name = "brlcad_bot_classic_kernel",
            .summary = "the shot function of brlcad_bot_classic alone, from the origin as given, on the whole line",
            .source = std::string(source),
            .contract = {.range = RangeRule::line, .t_min = EndRule::unspecified},
            .constants = {distance_tolerance, least_slope}};
  }

  explicit ClassicKernel(const Bag& bag) : target_(bag) {}
  bool possible() const { return finite_sides(target_.box()); }
  bool empty() const { return target_.empty(); }

  template <class Why>
  bool shoot(const Vector& origin, const Vector& direction, std::vector<Passage>& pieces, Why why) {
    hits_.clear();
    target_.hit_all(origin, direction, hits_, why);
    if (hits_.empty()) return true;
    sort(hits_);
    add_passages(target_.solid(), hits_, pieces);
    if (pieces.empty()) missed_by(Rejection::segment, why);
    return true;
  }

 private:
  Target target_;
  std::vector<Hit> hits_;
};

}  // namespace
}  // namespace brlcad

std::unique_ptr<Tracer> brlcad_bot_classic() { return std::make_unique<brlcad::BotTracer<brlcad::Classic>>(); }

std::unique_ptr<Tracer> brlcad_bot_classic_kernel() {
  return std::make_unique<brlcad::BotTracer<brlcad::ClassicKernel>>();
}

}  // namespace plumbline
