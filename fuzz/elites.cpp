#include "fuzz/elites.h"

#include <algorithm>
#include <array>

#include "case/fingerprint.h"

namespace plumbline {
namespace {

using Bytes = std::array<std::byte, longest_input>;

Bytes bytes_of(const FuzzInput& input) {
  Bytes bytes{};
  encode(input, std::span(bytes).first(input_size(input.space, input.precision)));
  return bytes;
}

}  // namespace

double score_in(Cell cell, const Features& features) {
  if ((cell & signature_cell) != 0) return features.found;
  return cell == worst_nominal_cell ? features.severity : features.error;
}

std::uint32_t& Elites::place(Cell cell) {
  return cell < plain_cells ? plain_[cell] : others_.try_emplace(cell, nowhere).first->second;
}

std::size_t Elites::offer(const FuzzInput& input, const Features& features) {
  changed_.clear();
  for (const Cell cell : std::span(features.cells).first(features.size)) {
    const Elite offered{cell, score_in(cell, features), features.nominal ? features.error : 0, input};
    std::uint32_t& at = place(cell);
    if (at == nowhere) {
      at = static_cast<std::uint32_t>(elites_.size());
      elites_.push_back(offered);
    } else {
      Elite& there = elites_[at];
      if (offered.score < there.score ||
          (offered.score == there.score && bytes_of(input) >= bytes_of(there.input)))
        continue;
      there = offered;
    }
    changed_.push_back(at);
  }
  return changed_.size();
}

const Elite* Elites::parent(Random& random) const {
  if (elites_.empty()) return nullptr;
  const auto any = [&] { return &elites_[random.below(elites_.size())]; };
  const Elite* best = any();
  if (!random.chance(4)) return best;
  for (int i = 0; i < 7; ++i)
    if (const Elite* other = any(); other->drive > best->drive) best = other;
  return best;
}

const Elite* Elites::at(Cell cell) const {
  if (cell < plain_cells) return plain_[cell] == nowhere ? nullptr : &elites_[plain_[cell]];
  const auto it = others_.find(cell);
  return it == others_.end() ? nullptr : &elites_[it->second];
}

std::uint64_t fingerprint(const Elite& elite) {
  Fingerprint print;
  for (int k = 0; k < 4; ++k) print.add(elite.cell >> 8 * k & 0xff);
  for (const std::byte b : bytes_of(elite.input)) print.add(static_cast<std::uint64_t>(b));
  return print.value();
}

std::uint64_t fingerprint(const Elites& elites) {
  std::uint64_t sum = 0;  // the order doesn't count
  for (const Elite& elite : elites.all()) sum += fingerprint(elite);
  return sum;
}

}  // namespace plumbline
