#include "float_tracer/brlcad/hierarchy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace plumbline::brlcad {
namespace {

constexpr std::size_t too_many = 8;  // for a leaf, unless the bits are used up
constexpr int bits_per_axis = 10;    // of the place on the curve
constexpr int bits_of_trees = 12;    // the upper bits, in which the places of a tree agree
constexpr std::size_t buckets = 12;
constexpr double nothing = 1e-77;

struct Placed {
  std::uint32_t place, triangle;
};

struct Branch {
  Box box;
  std::uint32_t first = 0, count = 0;  // of a leaf
  std::unique_ptr<Branch> low, high;
};

using Branches = std::vector<std::unique_ptr<Branch>>;

// Two zeros between every two bits.
std::uint32_t spread(std::uint32_t bits) {
  std::uint32_t result = 0;
  for (int i = 0; i < bits_per_axis; ++i) result |= (bits >> i & 1) << 3 * i;
  return result;
}

std::uint32_t place_of(const Vector& centre, const Box& centres) {
  constexpr std::uint32_t cells = 1 << bits_per_axis;
  std::uint32_t place = 0;
  for (int i = 0; i < 3; ++i) {
    double along = centre[i] - centres.low[i];
    if (centres.high[i] > centres.low[i]) along /= centres.high[i] - centres.low[i];
    place |= spread(std::min(static_cast<std::uint32_t>(along * cells), cells - 1)) << i;
  }
  return place;
}

// By place, those at the same in the order given.
std::vector<Placed> along_the_curve(std::span<const Triangle> triangles) {
  std::vector<Vector> centre;
  Box centres = empty_box();
  for (const Triangle& t : triangles) {
    centre.push_back((1.0 / 3.0) * (to_vec<double>(t.a) + to_vec<double>(t.b) + to_vec<double>(t.c)));
    add(centres, centre.back());
  }
  std::vector<Placed> placed;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) placed.push_back({place_of(centre[i], centres), i});
  std::ranges::sort(placed, {}, [](const Placed& p) { return std::pair(p.place, p.triangle); });
  return placed;
}

std::unique_ptr<Branch> joined(std::unique_ptr<Branch> low, std::unique_ptr<Branch> high) {
  auto branch = std::make_unique<Branch>();
  branch->box = low->box;
  add(branch->box, high->box);
  branch->low = std::move(low);
  branch->high = std::move(high);
  return branch;
}

// Cuts by this bit of the place and lower ones.
std::unique_ptr<Branch> tree_of(std::span<const Placed> placed, int bit, std::span<const Triangle> triangles,
                                std::vector<std::uint32_t>& order) {
  if (bit < 0 || placed.size() < too_many) {
    auto leaf = std::make_unique<Branch>();
    leaf->box = empty_box();
    leaf->first = static_cast<std::uint32_t>(order.size());
    leaf->count = static_cast<std::uint32_t>(placed.size());
    for (const Placed& p : placed) {
      add(leaf->box, box_of({&triangles[p.triangle], 1}));
      order.push_back(p.triangle);
    }
    return leaf;
  }
  const std::uint32_t mask = 1u << bit;
  const auto cut = std::ranges::partition_point(placed, [&](const Placed& p) { return (p.place & mask) == 0; });
  if (cut == placed.begin() || cut == placed.end()) return tree_of(placed, bit - 1, triangles, order);
  const auto count = static_cast<std::size_t>(cut - placed.begin());
  auto low = tree_of(placed.first(count), bit - 1, triangles, order);
  return joined(std::move(low), tree_of(placed.subspan(count), bit - 1, triangles, order));
}

double surface(const Box& box) {
  const Vector d = box.high - box.low;
  return 2.0 * (d.x * d.y + d.x * d.z + d.y * d.z);
}

double centre_along(int axis, const Box& box) { return (box.low[axis] + box.high[axis]) * 0.5; }

int longest_axis(const Box& box) {
  const Vector d = box.high - box.low;
  return d.x > d.y && d.x > d.z ? 0 : d.y > d.z ? 1 : 2;
}

struct Bucket {
  std::size_t count = 0;
  Box box{};  // not empty: around 0
};

// The bucket after which to part costs least; the first of equals.
std::size_t cheapest_cut(const std::array<Bucket, buckets>& filled, const Box& whole) {
  std::size_t best = 0;
  double least = 0;
  for (std::size_t i = 0; i + 1 < buckets; ++i) {
    Bucket below{0, empty_box()}, above{0, empty_box()};
    for (std::size_t j = 0; j < buckets; ++j) {
      Bucket& side = j <= i ? below : above;
      side.count += filled[j].count;
      add(side.box, filled[j].box);
    }
    const double cost = .125 + (static_cast<double>(below.count) * surface(below.box) +
                                static_cast<double>(above.count) * surface(above.box)) /
                                   surface(whole);
    if (i > 0 && !(cost < least)) continue;
    least = cost;
    best = i;
  }
  return best;
}

// Exchanges the first that belongs above with the last that belongs below, and so on inwards; the first that stays
// above.
template <class Below>
std::size_t part(std::span<std::unique_ptr<Branch>> branches, Below below) {
  std::size_t first = 0, last = branches.size();
  for (;;) {
    while (first != last && below(*branches[first])) ++first;
    if (first == last) return first;
    --last;
    while (first != last && !below(*branches[last])) --last;
    if (first == last) return first;
    std::swap(branches[first++], branches[last]);
  }
}

std::unique_ptr<Branch> tree_over(std::span<std::unique_ptr<Branch>> branches) {
  if (branches.size() == 1) return std::move(branches.front());
  Box whole = empty_box(), centres = empty_box();
  for (const auto& branch : branches) {
    add(whole, branch->box);
    add(centres, Vector{centre_along(0, branch->box), centre_along(1, branch->box), centre_along(2, branch->box)});
  }
  const int axis = longest_axis(centres);
  const double low = centres.low[axis], extent = centres.high[axis] - low;
  std::size_t middle = branches.size() / 2;
  if (!(std::abs(extent) < nothing)) {
    const auto bucket_of = [&](const Branch& branch) {
      const double share = (centre_along(axis, branch.box) - low) / extent;
      return std::min(static_cast<std::size_t>(static_cast<double>(buckets) * share), buckets - 1);
    };
    std::array<Bucket, buckets> filled;
    for (const auto& branch : branches) {
      Bucket& bucket = filled[bucket_of(*branch)];
      ++bucket.count;
      add(bucket.box, branch->box);
    }
    const std::size_t cut = cheapest_cut(filled, whole);
    middle = part(branches, [&](const Branch& branch) { return bucket_of(branch) <= cut; });
  }
  auto below = tree_over(branches.first(middle));
  return joined(std::move(below), tree_over(branches.subspan(middle)));
}

void flatten(const Branch& branch, std::vector<Hierarchy::Node>& nodes) {
  const std::size_t here = nodes.size();
  nodes.push_back({.box = branch.box, .first = branch.first, .count = branch.count});
  if (branch.count != 0) return;
  flatten(*branch.low, nodes);
  nodes[here].other = static_cast<std::uint32_t>(nodes.size());
  flatten(*branch.high, nodes);
}

}  // namespace

Hierarchy::Hierarchy(std::span<const Triangle> triangles) {
  constexpr int low_bits = 3 * bits_per_axis - bits_of_trees;
  const std::vector<Placed> placed = along_the_curve(triangles);
  Branches trees;
  for (std::span<const Placed> rest = placed; !rest.empty();) {
    const auto end = std::ranges::find_if(
        rest, [&](const Placed& p) { return p.place >> low_bits != rest.front().place >> low_bits; });
    const auto count = static_cast<std::size_t>(end - rest.begin());
    trees.push_back(tree_of(rest.first(count), low_bits - 1, triangles, order_));
    rest = rest.subspan(count);
  }
  flatten(*tree_over(trees), nodes_);
}

}  // namespace plumbline::brlcad
