#include "tests/oracle/stages.h"

#include <algorithm>

#include "oracle/accumulator.h"
#include "oracle/classify.h"
#include "oracle/integer.h"

namespace plumbline {
namespace {

LaneStages lane_stages(Isa isa) {
#if defined(__x86_64__)
  if (isa == Isa::avx512) return lane_stages_avx512;
  if (isa == Isa::avx2) return lane_stages_avx2;
#endif
  return lane_stages_portable;
}

std::optional<Truth> ask_lanes(Isa isa, bool residue, const Batch& batch, std::size_t i) {
  Batch one = batch;
  one.skip(i);
  one.size = 1;
  std::uint32_t undecided;
  const LaneCounts left = lane_stages(isa)(one, &undecided);
  if (residue ? left.past_residue != 0 : left.past_filter != 0) return std::nullopt;
  return batch.truths[i];
}

}  // namespace

Columns::Columns(std::span<const Shot> shots) {
  for (const auto& [t, r] : shots) {
    const double row[17] = {t.a.x,         t.a.y,         t.a.z,         t.b.x,      t.b.y,      t.b.z,
                            t.c.x,         t.c.y,         t.c.z,         r.origin.x, r.origin.y, r.origin.z,
                            r.direction.x, r.direction.y, r.direction.z, r.t_min,    r.t_max};
    for (std::size_t k = 0; k < 17; ++k) column_[k].push_back(row[k]);
  }
}

Batch Columns::batch(Truth* truths) const {
  Batch batch{.size = size(), .truths = truths};
  for (std::size_t k = 0; k < 9; ++k) batch.triangle[k] = column_[k].data();
  for (std::size_t k = 0; k < 8; ++k) batch.ray[k] = column_[9 + k].data();
  return batch;
}

std::string Stage::name() const {
  switch (kind) {
    case filter:
      return "filter " + std::string(plumbline::name(isa));
    case residue:
      return "residue " + std::string(plumbline::name(isa));
    case integer:
      return "integer";
    case wide:
      return "wide";
    case accumulate:
      return "accumulate";
    case single_call:
      break;
  }
  return "single call";
}

const std::vector<Isa>& all_isas() {
  static const std::vector<Isa> all = [] {
    std::vector<Isa> list;
    for (const Isa isa : {Isa::portable, Isa::avx2, Isa::avx512})
      if (available(isa)) list.push_back(isa);
    return list;
  }();
  return all;
}

const std::vector<Stage>& all_stages() {
  static const std::vector<Stage> all = [] {
    std::vector<Stage> list = {{Stage::integer}, {Stage::wide}, {Stage::accumulate}, {Stage::single_call}};
    for (const Isa isa : all_isas())
      for (const auto kind : {Stage::filter, Stage::residue}) list.push_back({kind, isa});
    return list;
  }();
  return all;
}

std::vector<std::optional<Truth>> ask(const Stage& stage, std::span<const Shot> shots) {
  const Columns columns(shots);
  std::vector<Truth> truths(shots.size());
  Batch batch = columns.batch(truths.data());
  batch.skip_filter = stage.kind == Stage::residue;
  std::vector<std::optional<Truth>> answers(shots.size());
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const auto& [triangle, ray] = shots[i];
    switch (stage.kind) {
      case Stage::filter:
      case Stage::residue:
        answers[i] = ask_lanes(stage.isa, stage.kind == Stage::residue, batch, i);
        break;
      case Stage::integer:
        answers[i] = classify_integer(triangle, ray);
        break;
      case Stage::wide:
        answers[i] = classify_wide(triangle, ray);
        break;
      case Stage::accumulate:
        answers[i] = classify_accumulate(triangle, ray);
        break;
      case Stage::single_call:
        answers[i] = classify(triangle, ray);
        break;
    }
  }
  return answers;
}

BlockRun run_blocks(Isa isa, std::span<const Shot> shots, bool skip_filter) {
  const Columns columns(shots);
  std::vector<Truth> truths(shots.size());
  Batch batch = columns.batch(truths.data());
  batch.skip_filter = skip_filter;
  std::vector<bool> decided(shots.size(), true);
  BlockRun run;
  std::array<std::uint32_t, lane_block> undecided;
  for (std::size_t first = 0; first < shots.size(); first += lane_block) {
    Batch block = batch;
    block.size = std::min<std::size_t>(lane_block, batch.size);
    const LaneCounts left = lane_stages(isa)(block, undecided.data());
    run.counts.past_filter += left.past_filter;
    run.counts.past_residue += left.past_residue;
    for (std::size_t k = 0; k < left.past_residue; ++k) decided[first + undecided[k]] = false;
    batch.skip(block.size);
  }
  for (std::size_t i = 0; i < shots.size(); ++i)
    run.truths.push_back(decided[i] ? std::optional(truths[i]) : std::nullopt);
  return run;
}

}  // namespace plumbline
