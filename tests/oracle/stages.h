// Each stage of classify alone, on cases in columns.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "case/hard_families.h"
#include "oracle/batch.h"

namespace plumbline {

/// Cases as the batch takes them.
class Columns {
 public:
  explicit Columns(std::span<const Shot> shots);
  /// Of all cases; the truths go to `truths`.
  Batch batch(Truth* truths) const;
  std::size_t size() const { return column_[0].size(); }

 private:
  std::array<std::vector<double>, 17> column_;
};

struct Stage {
  enum Kind { filter, residue, integer, wide, accumulate, single_call } kind;
  Isa isa = Isa::portable;  ///< filter, residue

  std::string name() const;
};

/// Every stage, the vector stages once for each instruction set there is here.
const std::vector<Stage>& all_stages();
const std::vector<Isa>& all_isas();

/// What the stage says when it is asked for each case alone; nothing where it passes the case on.
std::vector<std::optional<Truth>> ask(const Stage& stage, std::span<const Shot> shots);
inline std::optional<Truth> ask(const Stage& stage, const Shot& shot) {
  return ask(stage, std::span(&shot, 1)).front();
}

/// The vector stages over whole blocks, as a batch runs them; nothing where a case was left undecided.
struct BlockRun {
  std::vector<std::optional<Truth>> truths;
  LaneCounts counts;
};
BlockRun run_blocks(Isa isa, std::span<const Shot> shots, bool skip_filter);

}  // namespace plumbline
