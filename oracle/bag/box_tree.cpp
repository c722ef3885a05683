#include "oracle/bag/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace plumbline {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

struct Box {
  std::array<float, 3> low = {infinity, infinity, infinity}, high = {-infinity, -infinity, -infinity};

  void add(const Box& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
  double centre(std::size_t axis) const { return 0.5 * low[axis] + 0.5 * high[axis]; }
  double half_area() const {
    const double x = double{high[0]} - low[0], y = double{high[1]} - low[1], z = double{high[2]} - low[2];
    return x * y + y * z + z * x;
  }
};

float below(double x) {
  const auto f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -infinity) : f;
}
float above(double x) {
  const auto f = static_cast<float>(x);
  return f < x ? std::nextafter(f, infinity) : f;
}

Box box_of(const Triangle& t) {
  const auto extent = [](double a, double b, double c, float& low, float& high) {
    low = below(std::min({a, b, c}));
    high = above(std::max({a, b, c}));
  };
  Box box;
  extent(t.a.x, t.b.x, t.c.x, box.low[0], box.high[0]);
  extent(t.a.y, t.b.y, t.c.y, box.low[1], box.high[1]);
  extent(t.a.z, t.b.z, t.c.z, box.low[2], box.high[2]);
  return box;
}

class Builder {
 public:
  explicit Builder(std::span<const Triangle> triangles) {
    boxes_.reserve(triangles.size());
    for (const Triangle& t : triangles) boxes_.push_back(box_of(t));
    tree_.order.resize(triangles.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0u);
  }

  BoxTree build() {
    const auto size = static_cast<std::uint32_t>(boxes_.size());
    if (size == 0) return std::move(tree_);
    tree_.nodes.reserve(size / 2 + 1);
    add_node({0, size}, 0);
    tree_.nodes.shrink_to_fit();
    return std::move(tree_);
  }

 private:
  struct Range {
    std::uint32_t begin, end;
    std::uint32_t size() const { return end - begin; }
  };

  Box bounds(Range r) const {
    Box box;
    for (std::uint32_t i = r.begin; i < r.end; ++i) box.add(boxes_[tree_.order[i]]);
    return box;
  }

  std::uint32_t add_node(Range range, int depth) {
    const auto index = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.emplace_back();
    const std::uint32_t middle = range.size() > 1 ? split(range, depth) : range.end;
    const std::array<Range, 2> halves = {Range{range.begin, middle}, Range{middle, range.end}};
    for (std::size_t k = 0; k < 2; ++k) {
      const Box box = bounds(halves[k]);
      const bool leaf = halves[k].size() <= BoxTree::leaf_size;
      const std::uint32_t child = leaf ? halves[k].begin : add_node(halves[k], depth + 1);
      BoxNode& node = tree_.nodes[index];
      for (std::size_t i = 0; i < 3; ++i) {
        node.low[i][k] = box.low[i];
        node.high[i][k] = box.high[i];
      }
      node.child[k] = child;
      node.count[k] = leaf ? halves[k].size() : BoxNode::node;  // a lone triangle's other half is empty
    }
    return index;
  }

  // Where the range's second half begins, neither being empty. Deep down, or where a cut separates nothing, the middle.
  std::uint32_t split(Range range, int depth) {
    constexpr int deepest_heuristic = 90;  // and 32 halvings more
    if (depth < deepest_heuristic)
      if (const std::uint32_t middle = split_by_area(range); middle != range.begin && middle != range.end)
        return middle;
    return range.begin + range.size() / 2;
  }

  std::uint32_t split_by_area(Range range) {
    constexpr std::size_t bins = 16;
    std::array<double, 3> least, most;
    least.fill(infinity);
    most.fill(-infinity);
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double centre = boxes_[tree_.order[i]].centre(axis);
        least[axis] = std::min(least[axis], centre);
        most[axis] = std::max(most[axis], centre);
      }
    }
    double best_cost = std::numeric_limits<double>::infinity();
    std::size_t best_axis = 0, best_bin = 0;
    std::array<double, 3> scale;
    const auto bin_of = [&](std::uint32_t triangle, std::size_t axis) {
      const double bin = (boxes_[triangle].centre(axis) - least[axis]) * scale[axis];
      return bin < bins ? static_cast<std::size_t>(bin) : bins - 1;  // a centre of infinite bounds is no number
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double extent = most[axis] - least[axis];
      scale[axis] = bins / extent;
      // Bounds beyond binary32 are infinite, and their centres may be no numbers.
      if (!(extent > 0 && extent < infinity) || !std::isfinite(scale[axis])) continue;
      std::array<Box, bins> box;
      std::array<std::uint32_t, bins> count{};
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        const std::uint32_t triangle = tree_.order[i];
        const std::size_t bin = bin_of(triangle, axis);
        box[bin].add(boxes_[triangle]);
        ++count[bin];
      }
      std::array<double, bins> behind{};  // the cost of what lies behind a cut
      Box grown;
      std::uint32_t counted = 0;
      for (std::size_t k = bins - 1; k > 0; --k) {
        grown.add(box[k]);
        counted += count[k];
        behind[k] = counted == 0 ? 0 : grown.half_area() * counted;
      }
      grown = {};
      counted = 0;
      for (std::size_t k = 1; k < bins; ++k) {
        grown.add(box[k - 1]);
        counted += count[k - 1];
        if (counted == 0 || counted == range.size()) continue;
        const double cost = grown.half_area() * counted + behind[k];
        if (cost < best_cost) {
          best_cost = cost;
          best_axis = axis;
          best_bin = k;
        }
      }
    }
    if (best_bin == 0) return range.begin;
    const auto first = tree_.order.begin();
    const auto middle = std::partition(first + range.begin, first + range.end,
                                       [&](std::uint32_t triangle) { return bin_of(triangle, best_axis) < best_bin; });
    return static_cast<std::uint32_t>(middle - first);
  }

  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace

BoxTree BoxTree::build(std::span<const Triangle> triangles) { return Builder(triangles).build(); }

}  // namespace plumbline
