#include "oracle/bag/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "case/finite.h"
#include "case/input_error.h"
#include "oracle/bag/box_probe.h"
#include "oracle/bag/gather.h"
#include "oracle/bag/hit_order.h"
#include "oracle/classify.h"
#include "oracle/default_controls.h"
#include "oracle/invalid.h"

namespace plumbline {
namespace {

// Leaves by and large in the order in which the line enters them. `to` may come nearer meanwhile.
template <class Visit>
[[gnu::always_inline]] inline void visit_leaves(const BoxTree& tree, const Query& query, const double& to,
                                                Visit visit) {
  struct Waiting {
    std::uint32_t node;
    double near;
  };
  if (tree.nodes.empty()) return;
  const BoxProbe probe(query);
  std::array<Waiting, BoxTree::depth> stack;
  std::size_t waiting = 0;
  std::uint32_t at = 0;
  const auto next = [&] {
    while (waiting > 0) {
      const Waiting& last = stack[--waiting];
      // As in enter(): erring on the side of meeting.
      if (last.near - to > 0x1p-49 * (std::fabs(last.near) + std::fabs(to)) + 0x1p-1022) continue;
      at = last.node;
      return true;
    }
    return false;
  };
  for (;;) {
    const BoxNode& node = tree.nodes[at];
    const BoxEntry entry = enter(node, probe, query.ray.t_min, to);
    std::array<std::uint32_t, 2> inner;
    std::size_t inner_count = 0;
    const std::uint32_t first = entry.near[1] < entry.near[0] ? 1 : 0;
    for (const std::uint32_t k : {first, 1 - first}) {
      if ((entry.met >> k & 1) == 0) continue;
      if (node.count[k] == BoxNode::node)
        inner[inner_count++] = k;
      else
        visit(node.child[k], node.count[k]);
    }
    if (inner_count == 2) stack[waiting++] = {node.child[inner[1]], entry.near[inner[1]]};
    if (inner_count > 0)
      at = node.child[inner[0]];
    else if (!next())
      return;
  }
}

}  // namespace

Scene::Scene(std::span<const Triangle> triangles) {
  const DefaultControls controls;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (!is_finite(triangles[i]))
      throw InputError("triangle " + std::to_string(i) + " of the scene has a coordinate that is NaN or infinite");
  tree_ = BoxTree::build(triangles);
  triangles_.reserve(triangles.size());
  position_.resize(triangles.size());
  for (std::uint32_t k = 0; k < triangles.size(); ++k) {
    triangles_.push_back(triangles[tree_.order[k]]);
    position_[tree_.order[k]] = k;
  }
}

std::size_t Scene::bytes() const {
  return sizeof(*this) + tree_.nodes.capacity() * sizeof(BoxNode) +
         (tree_.order.capacity() + position_.capacity()) * sizeof(std::uint32_t) +
         triangles_.capacity() * sizeof(Triangle);
}

BagTruth Scene::truth(const Query& query) const {
  const DefaultControls controls;
  BagTruth truth;
  truth.invalid = why_invalid(Triangle{}, query.ray);
  if (truth.invalid != Invalid::none) return truth;
  visit_leaves(tree_, query, query.ray.t_max, [&](std::uint32_t begin, std::uint32_t count) {
    for (std::uint32_t k = begin; k < begin + count; ++k) gather(truth, triangles_[k], tree_.order[k], query);
  });
  settle(truth, query, [&](std::uint32_t i) -> const Triangle& { return triangles_[position_[i]]; });
  return truth;
}

void Scene::boxes_met(const Query& query, std::vector<std::uint32_t>& triangles) const {
  const DefaultControls controls;
  triangles.clear();
  if (why_invalid(Triangle{}, query.ray) != Invalid::none) return;
  visit_leaves(tree_, query, query.ray.t_max, [&](std::uint32_t begin, std::uint32_t count) {
    for (std::uint32_t k = begin; k < begin + count; ++k) triangles.push_back(tree_.order[k]);
  });
  std::ranges::sort(triangles);
}

void Scene::nearest(std::span<const Query> queries, NearestHits& hits) const {
  const DefaultControls controls;
  hits.owners_.clear();
  hits.end_.clear();
  hits.end_.reserve(queries.size());
  for (const Query& query : queries) {
    nearest(query, hits.owners_);
    hits.end_.push_back(static_cast<std::uint32_t>(hits.owners_.size()));
  }
}

void Scene::nearest(const Query& query, std::vector<NearestHits::Owner>& owners) const {
  if (why_invalid(Triangle{}, query.ray) != Invalid::none) return;
  const std::size_t begin = owners.size();
  RoughT best{0, std::numeric_limits<double>::infinity()};
  double to = query.ray.t_max;
  visit_leaves(tree_, query, to, [&](std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t k = first; k < first + count; ++k) {
      const Truth truth = classify(triangles_[k], query);
      if (!crosses(truth)) continue;
      const RoughT here = rough_t(triangles_[k], query);
      if (owners.size() > begin) {
        // compare_t, of which the first part is known here.
        const double apart = here.centre - best.centre, reach = 1.0625 * (here.radius + best.radius);
        if (apart > reach) continue;
        if (!(-apart > reach)) {
          const auto& rival = owners[begin];
          const auto order = compare_t({triangles_[k], truth}, {triangles_[rival.triangle], rival.truth}, query);
          if (order > 0) continue;
          if (order == 0) {
            owners.push_back({k, truth});
            continue;
          }
        }
        owners.resize(begin);
      }
      owners.push_back({k, truth});
      best = here;
      to = std::min(to, here.centre + here.radius * 1.0625);
    }
  });
  for (std::size_t i = begin; i < owners.size(); ++i) owners[i].triangle = tree_.order[owners[i].triangle];
  std::sort(owners.begin() + static_cast<std::ptrdiff_t>(begin), owners.end(),
            [](const auto& x, const auto& y) { return x.triangle < y.triangle; });
}

}  // namespace plumbline
