// Many triangles, prepared for many rays: the truth of bag_truth.h, found in a tree of boxes, and the nearest hit fast.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "oracle/bag/bag_truth.h"
#include "oracle/bag/box_tree.h"

namespace plumbline {

/// What each of a span of queries hits first: all triangles at the least exact t within its range.
class NearestHits {
 public:
  struct Owner {
    std::uint32_t triangle;
    Truth truth;
  };

  std::size_t size() const { return end_.size(); }
  /// By index; none where nothing is crossed.
  std::span<const Owner> of(std::size_t query) const {
    const std::uint32_t begin = query == 0 ? 0 : end_[query - 1];
    return {owners_.data() + begin, end_[query] - begin};
  }

 private:
  friend class Scene;
  std::vector<Owner> owners_;
  std::vector<std::uint32_t> end_;
};

/// Immutable, and so to be asked by any number of threads. The same answers in every rounding mode, FTZ and DAZ or not.
class Scene {
 public:
  /// Keeps a copy. Throws InputError naming the first triangle that isn't finite; at most 2^31 triangles.
  explicit Scene(std::span<const Triangle> triangles);

  /// bag_truth of all triangles.
  BagTruth truth(const Query& query) const;

  /// Replaces `triangles` by those that the query may touch, and a few that it doesn't: those whose boxes it meets.
  void boxes_met(const Query& query, std::vector<std::uint32_t>& triangles) const;

  /// Replaces `hits`. An invalid query hits nothing. What is touched without being crossed is no hit.
  void nearest(std::span<const Query> queries, NearestHits& hits) const;

  std::size_t size() const { return triangles_.size(); }
  /// Of memory, all told.
  std::size_t bytes() const;

 private:
  void nearest(const Query& query, std::vector<NearestHits::Owner>& owners) const;

  BoxTree tree_;
  std::vector<Triangle> triangles_;      // in the order of the tree
  std::vector<std::uint32_t> position_;  // where in it a triangle is
};

}  // namespace plumbline
