#include "float_tracer/brlcad/cells.h"

#include <algorithm>
#include <cmath>

namespace plumbline::brlcad {
namespace {

constexpr std::size_t deepest = 12;     // cuts one below the other
constexpr std::size_t always_down = 6;  // so deep cells are cut however few pieces are left,
constexpr std::size_t few = 3;          // and below only if there are more than this
constexpr double beside = 0.1;          // the side of a piece
constexpr double thinnest = 2;          // to be cut

constexpr int far_too_many_steps = 1 << 16;  // of a walk: there are fewer cells

struct Cut {
  int axis;
  double at;
};

// Near the middle of the cell.
std::optional<double> cut_along(int axis, const Cell& cell, std::span<const Box> pieces) {
  const double left = cell.box.low[axis], right = cell.box.high[axis];
  if (right - left < thinnest) return std::nullopt;
  const double middle = (left + right) * 0.5;
  double at = left, distance = middle - left, least = 1e73, most = -least;
  const auto consider = [&](double side, double away) {
    least = std::min(least, side);
    most = std::max(most, side);
    if (std::abs(side - middle) >= distance) return;
    distance = std::abs(side - middle);
    at = side + away;
  };
  for (auto it = cell.pieces.rbegin(); it != cell.pieces.rend(); ++it) {
    consider(pieces[*it].low[axis], -beside);
    consider(pieces[*it].high[axis], beside);
  }
  if (at < least || at > most) at = (most + least) / 2.0;
  if (at <= left || at >= right || at - left <= 1.0 || right - at <= 1.0) return std::nullopt;
  return at;
}

// Beside what a cell holds, if it is more than half empty along that axis; the emptier of both sides of the emptiest.
std::optional<Cut> cut_beside_content(const Cell& cell, std::span<const Box> pieces) {
  Box content = empty_box();
  for (const std::uint32_t piece : cell.pieces) add(content, pieces[piece]);
  Cut cut{};
  double most = 0;
  bool above = false;
  for (int i = 0; i < 3; ++i) {
    const double over = cell.box.high[i] - std::min(content.high[i], cell.box.high[i]);
    const double under = std::max(content.low[i], cell.box.low[i]) - cell.box.low[i];
    const double emptiness = under > over ? under : over;
    if (i > 0 && !(emptiness > most)) continue;
    most = emptiness;
    above = !(under > over);
    cut.axis = i;
  }
  const double low = cell.box.low[cut.axis], high = cell.box.high[cut.axis];
  if (!(most / (high - low) > 0.5)) return std::nullopt;
  cut.at = above ? content.high[cut.axis] + distance_tolerance : content.low[cut.axis] - distance_tolerance;
  if (cut.at - low < thinnest || high - cut.at < thinnest) return std::nullopt;
  return cut;
}

bool reaches_into(const Box& piece, const Box& cell) {
  for (int i = 0; i < 3; ++i)
    if (cell.low[i] > piece.high[i] + distance_tolerance || piece.low[i] > cell.high[i] + distance_tolerance)
      return false;
  return true;
}

}  // namespace

std::vector<Box> piece_boxes(const Solid& solid) {
  const double aside = solid.mode != BagMode::plate                ? distance_tolerance
                       : solid.position == PlatePosition::appended ? solid.thickness
                                                                   : solid.thickness * 0.51;
  std::vector<Box> boxes((solid.faces.size() + faces_in_piece - 1) / faces_in_piece, empty_box());
  for (std::size_t i = 0; i < solid.faces.size(); ++i) {
    const Face& face = solid.faces[i];
    for (const Vector& corner : {face.a, face.ab + face.a, face.ac + face.a})
      for (const Vector& point : {corner, corner + aside * face.unit_normal, corner + -aside * face.unit_normal})
        add(boxes[i / faces_in_piece], point);
  }
  return boxes;
}

// ---- The tree

Cells::Cells(const Box& model_box, std::span<const Box> pieces) : model_box_(model_box), nodes_(1) {
  nodes_[0].cell.box = model_box;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) nodes_[0].cell.pieces.push_back(i);
  refine(0, 0, pieces);
  for (std::size_t i = 0; i < nodes_.size(); ++i) cut_off_emptiness(i, pieces);  // also those that it adds
}

const Cell& Cells::at(const Vector& point) const {
  const Node* node = &nodes_[0];
  while (node->axis >= 0) node = &nodes_[point[node->axis] < node->cut ? node->low : node->high];
  return node->cell;
}

// Unless it is to be done anyway, one side has to be left with fewer pieces, but some.
bool Cells::split(std::size_t node, int axis, double cut, std::span<const Box> pieces, bool anyway) {
  const Cell& whole = nodes_[node].cell;
  Node low{.cell = {whole.box, {}}}, high{.cell = {whole.box, {}}};
  low.cell.box.high[axis] = cut;
  high.cell.box.low[axis] = cut;
  bool simpler = false;
  for (Cell* side : {&low.cell, &high.cell}) {
    for (auto it = whole.pieces.rbegin(); it != whole.pieces.rend(); ++it)  // so their order turns round
      if (reaches_into(pieces[*it], side->box)) side->pieces.push_back(*it);
    simpler |= !side->pieces.empty() && side->pieces.size() < whole.pieces.size();
  }
  if (!simpler && !anyway) return false;
  nodes_[node] = {.cell = {}, .axis = axis, .cut = cut, .low = nodes_.size(), .high = nodes_.size() + 1};
  nodes_.push_back(std::move(low));
  nodes_.push_back(std::move(high));
  return true;
}

void Cells::refine(std::size_t node, std::size_t depth, std::span<const Box> pieces) {
  const std::size_t count = nodes_[node].cell.pieces.size();
  if (count <= 1 || depth > deepest || (depth >= always_down && count <= few)) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>((depth + i) % 3);
    const auto cut = cut_along(axis, nodes_[node].cell, pieces);
    if (!cut || !split(node, axis, *cut, pieces, false)) continue;
    const std::size_t low = nodes_[node].low, high = nodes_[node].high;
    refine(low, depth + 1, pieces);
    refine(high, depth + 1, pieces);
    return;
  }
}

void Cells::cut_off_emptiness(std::size_t node, std::span<const Box> pieces) {
  if (nodes_[node].axis >= 0 || nodes_[node].cell.pieces.empty()) return;
  if (const auto cut = cut_beside_content(nodes_[node].cell, pieces)) split(node, cut->axis, cut->at, pieces, true);
}

// ---- The walk

CellWalk::CellWalk(const Cells& cells, const Box& solid_box, const Vector& origin, const Vector& direction)
    : cells_(cells), solid_box_(solid_box), line_(origin, direction) {
  const auto model = slab_test(cells.model_box(), origin, line_.inverse);
  over_ = !model || model->far < 0;
  if (over_) return;
  end_ = model_end_ = model->far;
  start_ = model->near;
  if (start_ < -look_back) {
    start_ = first_start(*model);
    behind_ = start_ < -look_back;
  }
}

// Goes through all cells ahead. Of one solid, a single cell with pieces tells whether its box reaches farther back.
double CellWalk::first_start(const Span& model) {
  std::optional<double> start;
  double at = 0;
  for (int steps = 0; at <= model.far && !stuck_; ++steps) {
    const Cell& cell = cells_.at(line_.origin + at * line_.direction);
    const auto way = slab_test(cell.box, line_.origin, line_.inverse);
    if (!way) break;
    if (!start && !cell.pieces.empty()) {
      const auto solid = slab_test(solid_box_, line_.origin, line_.inverse);
      start = solid ? std::min(solid->near, -look_back) : -look_back;
    }
    at = way->far + distance_tolerance;
    stuck_ = steps > far_too_many_steps;
  }
  return start.value_or(-look_back);
}

const Cell* CellWalk::advance() {
  if (over_) return nullptr;
  double at = start_;
  int pushes = 0;
  for (int steps = 0; !stuck_; ++steps) {
    at += distance_tolerance;
    point_ = line_.origin + at * line_.direction;
    if (left_behind(cells_.model_box(), point_, line_.direction)) return nullptr;
    const Cell& cell = cells_.at(point_);
    if (&cell != last_) {
      pushes = 0;
      if (const auto way = slab_test(cell.box, point_, line_.inverse)) {
        last_ = &cell;
        moved_ = at;
        start_ = at + way->near;
        end_ = at + way->far;
        return &cell;
      }
    }
    const double step = std::max(end_, 1.0);
    start_ = end_ + step;
    end_ = start_ + step;
    if (++pushes > 3 || start_ > model_end_) return nullptr;
    at = start_ + distance_tolerance;
    stuck_ = steps > far_too_many_steps;
  }
  return nullptr;
}

const Cell* CellWalk::next() {
  for (;;) {
    if (last_) start_ = end_;
    const Cell* cell = advance();
    if (!cell) {
      over_ = true;
      return nullptr;
    }
    if (!cell->pieces.empty() && (behind_ || end_ >= -look_back)) return cell;
  }
}

}  // namespace plumbline::brlcad
