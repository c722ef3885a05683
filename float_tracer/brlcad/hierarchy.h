// The hierarchy of boxes that BRL-CAD has built over a BoT's faces since 7.42, HLBVH: K. Garanzha, J. Pantaleoni, D.
// McAllister, "Simpler and Faster HLBVH with Work Queues", High Performance Graphics 2011, as M. Pharr's and G.
// Humphreys's pbrt has it. Which faces share a leaf decides what its unwidened box culls, and the order of the leaves
// in which order hits at one distance come.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "float_tracer/brlcad/solid.h"

namespace plumbline::brlcad {

class Hierarchy {
 public:
  struct Node {
    Box box;
    std::uint32_t first = 0, count = 0;  ///< of a leaf: its part of `order`
    std::uint32_t other = 0;             ///< of an inner node (count 0): its second child; the first is the next node
  };

  /// Over these triangles, at least one. Their centres get a place on a curve through 1024^3 cells; those in the same
  /// of 16^3 parts of it make a tree, cut by the bits of the place down to fewer than eight; above, the trees are
  /// parted by the cost of their surfaces, in twelve buckets, to which librt, unlike pbrt, lets the point 0 belong as
  /// well.
  explicit Hierarchy(std::span<const Triangle> triangles);

  const Box& box() const { return nodes_.front().box; }

  /// Calls visit(i) with the index of every triangle of every leaf where meets(box) is true down from the root.
  template <class Meets, class Visit>
  void for_each(Meets meets, Visit visit) const {
    visit_from(0, meets, visit);
  }

 private:
  template <class Meets, class Visit>
  void visit_from(std::uint32_t i, Meets& meets, Visit& visit) const {
    const Node& node = nodes_[i];
    if (!meets(node.box)) return;
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) visit(order_[k]);
    if (node.count != 0) return;
    visit_from(i + 1, meets, visit);
    visit_from(node.other, meets, visit);
  }

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace plumbline::brlcad
