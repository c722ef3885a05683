// BoTs of more than 32 faces, up to 7.40: the faces in pieces of four, and the cells that the ray walk cuts their model
// into, each with the pieces whose boxes reach into it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "float_tracer/brlcad/walk.h"

namespace plumbline::brlcad {

inline constexpr std::size_t most_faces_in_one = 32;  ///< of the bag, before any is dropped
inline constexpr std::size_t faces_in_piece = 4;      ///< in the bag's order

/// The boxes of the pieces, of which the solid's box is the sum. Each is widened along the normals of its faces: of a
/// plate by 0.51 of its thickness, by all of it where it is appended, and otherwise by 0.0005.
std::vector<Box> piece_boxes(const Solid& solid);

struct Cell {
  Box box;
  std::vector<std::uint32_t> pieces;  ///< in the order in which the cutting has left them
};

/// A binary tree of cuts: near the middle, 0.1 beside the side of a piece, while that leaves fewer pieces on one side
/// and a cell more than 1 wide on both; then cells that are more than half empty are cut beside what they hold.
class Cells {
 public:
  Cells(const Box& model_box, std::span<const Box> pieces);
  const Box& model_box() const { return model_box_; }
  const Cell& at(const Vector& point) const;

 private:
  struct Node {
    Cell cell;      // of a leaf
    int axis = -1;  // of a cut; negative: a leaf
    double cut = 0;
    std::size_t low = 0, high = 0;  // the two sides of it
  };
  bool split(std::size_t node, int axis, double cut, std::span<const Box> pieces, bool anyway);
  void refine(std::size_t node, std::size_t depth, std::span<const Box> pieces);
  void cut_off_emptiness(std::size_t node, std::span<const Box> pieces);

  Box model_box_;
  std::vector<Node> nodes_;
};

/// A ray's way from cell to cell.
class CellWalk {
 public:
  /// Begins where the ray enters the model, but no more than 2 behind its origin; if the solid's box reaches farther
  /// back, where that begins.
  CellWalk(const Cells& cells, const Box& solid_box, const Vector& origin, const Vector& direction);

  /// Moves on to the next cell that holds pieces. Null: the ray has left the model, or never entered it. Each cell is
  /// entered 0.0005 beyond the end of the last, so one that the ray crosses for less is jumped over; where rounding has
  /// left the ray in the same cell, or beside the one it is in, it is pushed 1 and more ahead.
  const Cell* next();

  /// Whether it never ends: of a direction so short that its parameters are huge, the step of 0.0005 is lost in
  /// rounding, and librt stays in a cell for good. Known only when `next` has returned null.
  bool stuck() const { return stuck_; }

  const Line& line() const { return line_; }
  const Vector& point() const { return point_; }  ///< the moved origin
  double moved() const { return moved_; }         ///< by this parameter along the direction
  double end() const { return end_; }             ///< of the ray's way through the cell

 private:
  double first_start(const Span& model);
  const Cell* advance();

  const Cells& cells_;
  const Box& solid_box_;
  Line line_;
  Vector point_{};
  const Cell* last_ = nullptr;
  double moved_ = 0, start_ = 0, end_ = 0, model_end_ = 0;
  bool over_ = false;  // the ray has left the model, or misses it
  bool stuck_ = false;
  bool behind_ = true;  // what ends more than 2 behind the origin is looked at
};

}  // namespace plumbline::brlcad
