#include "float_tracer/brlcad/passages.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace plumbline::brlcad {
namespace {

using Hits = std::vector<Hit>;

Passage between(const Hit& in, const Hit& out) { return {in.t, out.t, in.face, out.face}; }

void remove_at(Hits& hits, std::size_t i) { hits.erase(hits.begin() + static_cast<std::ptrdiff_t>(i)); }

void pair_up(const Hits& hits, std::vector<Passage>& passages) {
  for (std::size_t i = 0; i + 1 < hits.size(); i += 2) passages.push_back(between(hits[i], hits[i + 1]));
}

// The slope of the hit is as long as the direction; of a plate without cosine the thickness is a parameter.
Passage through_plate(const Solid& solid, const Hit& hit) {
  const double way = solid.cosine ? std::abs(solid.thickness / hit.slope) : solid.thickness;
  const double in = solid.position == PlatePosition::centred ? hit.t - way * 0.5 : hit.t;
  return {in, in + way, hit.face, hit.face};
}

void pair_unoriented(Hits& hits, std::vector<Passage>& passages) {
  if (hits.size() == 1) {
    passages.push_back(between(hits[0], hits[0]));
    return;
  }
  std::optional<double> merged;
  for (std::size_t i = 0; i + 1 < hits.size();) {
    if (!near(hits[i].t, hits[i + 1].t)) {
      ++i;
      continue;
    }
    merged = hits[i + 1].t;
    remove_at(hits, i);
  }
  if (hits.size() == 1) return;
  if (hits.size() % 2 == 1 && merged) {
    constexpr double nothing = 1e-77;
    const auto it = std::ranges::find_if(hits, [&](const Hit& h) { return std::abs(h.t - *merged) < nothing; });
    if (it != hits.end()) hits.erase(it);
  }
  pair_up(hits, passages);
}

bool leaves(const Hit& hit) { return hit.slope > 0; }
bool enters(const Hit& hit) { return hit.slope < 0; }

// Whether entries and exits could be put in turn up to `end`, the first hit an entry. Counted from the first hit of
// all, and what doesn't leave counts as an entry.
bool balanced(const Hits& hits, std::size_t end) {
  const auto exits =
      static_cast<std::size_t>(std::count_if(hits.begin(), hits.begin() + static_cast<std::ptrdiff_t>(end), leaves));
  return exits == end / 2;
}

// Swaps the hits from `begin` to `end` so that those of an even number enter and those of an odd one leave, and puts
// them at one distance. False where one to swap with is missing.
bool put_in_turn(Hits& hits, std::size_t begin, std::size_t end) {
  bool changed = false, done = true;
  for (std::size_t j = begin; j < end && done; ++j) {
    const auto wanted = j % 2 == 1 ? leaves : enters, unwanted = j % 2 == 1 ? enters : leaves;
    if (wanted(hits[j])) continue;
    const auto rest = hits.begin() + static_cast<std::ptrdiff_t>(j) + 1;
    const auto last = hits.begin() + static_cast<std::ptrdiff_t>(end);
    if (const auto other = std::find_if(rest, last, wanted); other != last) {
      std::swap(hits[j], *other);
      changed = true;
    }
    done = !unwanted(hits[j]);
  }
  if (changed)
    for (std::size_t j = begin + 1; j < end; ++j) hits[j].t = hits[begin].t;
  return done;
}

// Keeps one hit that is opposite to the hit before `begin` and the next that is opposite to that; where there are none,
// one of hits that are all alike. False if nothing was erased.
bool thin_out(Hits& hits, std::size_t begin, std::size_t end) {
  std::optional<std::size_t> first, second;
  double before = begin == 0 ? 1.0 : hits[begin - 1].slope;
  for (std::size_t j = begin; j < end && !second; ++j) {
    if (!(before * hits[j].slope < 0)) continue;
    (first ? second : first) = j;
    before = hits[j].slope;
  }
  if (!second) {
    const auto from = hits.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto to = hits.begin() + static_cast<std::ptrdiff_t>(end);
    const auto exits = std::count_if(from, to, leaves);
    if (exits != 0 && exits != to - from) return false;
    hits.erase(from + 1, to);
    return true;
  }
  for (std::size_t j = end; j-- > begin;)
    if (j != *first && j != *second) remove_at(hits, j);
  return true;
}

void merge_oriented(Hits& hits) {
  for (std::size_t i = 0; i + 1 < hits.size();) {
    std::size_t end = i + 1;
    while (end < hits.size() && near(hits[i].t, hits[end].t)) ++end;
    if (end - i == 2 && hits[i].slope * hits[i + 1].slope > 0) {
      remove_at(hits, i);
    } else {
      const bool in_turn = end - i <= 2 || (balanced(hits, end) && put_in_turn(hits, i, end));
      if (in_turn || !thin_out(hits, i, end)) ++i;
    }
  }
}

void pair_oriented(Hits& hits, std::vector<Passage>& passages) {
  merge_oriented(hits);
  for (std::size_t i = 0; i + 1 < hits.size(); ++i)
    if (enters(hits[i])) {
      while (i + 1 < hits.size() && enters(hits[i + 1])) remove_at(hits, i);
    } else if (leaves(hits[i])) {
      while (i + 1 < hits.size() && leaves(hits[i + 1])) remove_at(hits, i + 1);
    }
  while (!hits.empty() && leaves(hits.front())) remove_at(hits, 0);
  while (!hits.empty() && enters(hits.back())) hits.pop_back();
  if (hits.size() % 2 == 1) hits.push_back(hits.back());
  pair_up(hits, passages);
}

}  // namespace

void add_passages(const Solid& solid, Hits& hits, std::vector<Passage>& passages) {
  switch (solid.mode) {
    case BagMode::surface:
      for (const Hit& hit : hits) passages.push_back(between(hit, hit));
      return;
    case BagMode::plate:
      for (const Hit& hit : hits) passages.push_back(through_plate(solid, hit));
      return;
    case BagMode::solid:
      break;
  }
  if (solid.oriented())
    pair_oriented(hits, passages);
  else
    pair_unoriented(hits, passages);
}

}  // namespace plumbline::brlcad
