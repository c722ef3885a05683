// What comes of one ray, from the hits of the faces to the partitions; its memory is kept for the next.
#pragma once
#include <cstddef>
#include <vector>

#include "float_tracer/brlcad/passages.h"
#include "float_tracer/brlcad/weave.h"
#include "float_tracer/rejection.h"

namespace plumbline::brlcad {

class Shot {
 public:
  std::vector<Hit> hits;

  void clear() {
    hits.clear();
    passages_.clear();
  }

  /// Makes passages of the hits, which are sorted and counted from an origin that was moved so far, beside those that
  /// are there.
  void gather(const Solid& solid, double moved) {
    const std::size_t before = passages_.size();
    add_passages(solid, hits, passages_);
    for (std::size_t i = before; i < passages_.size(); ++i) {
      passages_[i].in += moved;
      passages_[i].out += moved;
    }
  }

  /// Fills in the partitions. `why` is told of a miss: Rejection::segment if the hits made no passage, or t.
  template <class Why>
  void weave(std::vector<Passage>& partitions, Why why) {
    if (passages_.empty()) {
      missed_by(Rejection::segment, why);
      return;
    }
    weaver_.weave(passages_, partitions);
    if (partitions.empty()) missed_by(Rejection::t, why);
  }

 private:
  std::vector<Passage> passages_;
  Weaver weaver_;
};

}  // namespace plumbline::brlcad
