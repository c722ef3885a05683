// How BRL-CAD weaves what it hit of a model's one region into partitions, which are what its caller is told.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "case/answer.h"

namespace plumbline::brlcad {

/// Keeps its memory from ray to ray.
class Weaver {
 public:
  /// Fills `partitions` from `passages`, whose ends it may move.
  ///
  /// One after the other in the order given, a passage is cut at the ends of those before it, and they at its: ends
  /// nearer than 0.0005 to each other, or to the origin, are made equal, the later to the earlier mostly. One without
  /// length is left out where it touches another. A passage with a NaN, or that ends before it begins, is dropped, and
  /// so is one that ends more than 10 behind the origin. Then, in order along the ray: what does not reach 0.0005
  /// beyond the origin is dropped, and what follows on the one before it becomes one with it. A plate around the origin
  /// is kept, with in < 0. Where two still overlap, librt takes that for a defect and drops all that follows.
  void weave(std::vector<Passage>& passages, std::vector<Passage>& partitions);

 private:
  // An end is that of a passage, shared by all who begin or end there: in of the i-th is 2i, out 2i + 1.
  using End = std::uint32_t;
  struct Partition {
    End in, out;
  };
  double& t(End end);
  std::uint32_t triangle(End end) const;
  void insert(std::size_t before, Partition partition);
  void weave_passage(std::uint32_t i);
  void weave_point(std::uint32_t i);
  void finish();

  std::span<Passage> passages_;
  std::vector<Partition> woven_, finished_;
};

}  // namespace plumbline::brlcad
