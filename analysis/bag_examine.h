// A tracer asked about a bag as a whole, and judged: what examine.h is for one triangle.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"
#include "case/hit_class.h"
#include "float_tracer/tracer.h"
#include "oracle/bag/bag_truth.h"
#include "oracle/bag/judge.h"

namespace plumbline {

struct BagExamination {
  Case put;     ///< as the tracer was put it: at its precision
  Query query;  ///< what it was really asked, in the range that its contract says is searched
  Answer answer;
  BagTruth truth;  ///< of the bag and the query
  BagJudgement judgement;
  bool culling = false;  ///< wrong, and hit if asked with a triangle alone: lost in boxes or traversal
  bool died = false;     ///< the tracer, of this case
  Conduct conduct;       ///< what it did beside

  bool wrong() const {
    return judgement.verdict != BagVerdict::correct && judgement.verdict != BagVerdict::unspecified &&
           judgement.verdict != BagVerdict::fault;
  }
};

/// Asks with bags of its own. The triangles are at most 2^32 - 1. Throws InputError where they aren't surfaces.
BagExamination examine_bag(const Tracer& tracer, const Case& asked);

/// What makes two findings of one tracer in bags the same.
struct BagSignature {
  BagVerdict verdict = BagVerdict::leak;  ///< fault: the tracer, in a child, died of it
  HitClass where = HitClass::interior;  ///< of what has to be hit first, the least exceptional: interior, edge, vertex;
                                        ///< exterior: nothing has to be
  bool culling = false;
  bool through = false;  ///< of a wrong nearest hit: what is reported does lie on the ray, behind what was missed. Else
                         ///< it lies beside the ray: mostly a neighbour
  friend bool operator==(const BagSignature&, const BagSignature&) = default;
};

/// Of a judgement that is wrong.
BagSignature signature(const BagJudgement& judgement, bool culling);
/// Of a ray that the tracer died of.
inline constexpr BagSignature death_signature{BagVerdict::fault, HitClass::exterior, false, false};

/// No value where there is nothing to find.
std::optional<BagSignature> signature(const BagExamination& examination);

/// One word: "leak-edge-culling", "wrong-nearest-interior-through", "false-hit", "death".
std::string to_word(const BagSignature& signature);

}  // namespace plumbline
