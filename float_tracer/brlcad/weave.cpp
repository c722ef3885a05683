#include "float_tracer/brlcad/weave.h"

#include <cmath>
#include <cstddef>

#include "float_tracer/brlcad/solid.h"

namespace plumbline::brlcad {
namespace {

constexpr double farthest_behind = -10;  // what ends before that is not looked at
constexpr double nothing = 1e-77;        // a difference that counts as none

}  // namespace

double& Weaver::t(End end) { return end % 2 == 0 ? passages_[end / 2].in : passages_[end / 2].out; }

std::uint32_t Weaver::triangle(End end) const {
  return end % 2 == 0 ? passages_[end / 2].triangle_in : passages_[end / 2].triangle_out;
}

void Weaver::insert(std::size_t before, Partition partition) {
  woven_.insert(woven_.begin() + static_cast<std::ptrdiff_t>(before), partition);
}

// A passage without length.
void Weaver::weave_point(std::uint32_t i) {
  const auto [in, out] = Partition{2 * i, 2 * i + 1};
  if (t(out) < t(woven_.front().in)) return insert(0, {in, out});
  for (std::size_t p = 0; p < woven_.size(); ++p) {
    const double begin = t(woven_[p].in), end = t(woven_[p].out);
    if (near(t(in), begin) || near(t(out), begin) || near(t(in), end) || near(t(out), end)) return;
    if (t(out) <= end && t(in) >= begin) return;
    if (p + 1 == woven_.size() || t(out) < t(woven_[p + 1].in)) return insert(p + 1, {in, out});
  }
}

// Goes along the partitions; `begin` is where the part of the passage begins that isn't woven in yet.
void Weaver::weave_passage(std::uint32_t i) {
  const auto [in, out] = Partition{2 * i, 2 * i + 1};
  if (woven_.empty()) return woven_.push_back({in, out});
  if (near(t(in), t(out))) return weave_point(i);
  if (t(in) >= t(woven_.back().out)) return woven_.push_back({in, out});

  End begin = in;
  for (std::size_t p = 0; p < woven_.size(); ++p) {
    const double past_end = t(begin) - t(woven_[p].out);
    if (past_end > distance_tolerance) continue;
    const double past_begin = t(begin) - t(woven_[p].in);
    if (past_end > -distance_tolerance && past_begin > distance_tolerance) {
      t(begin) = t(woven_[p].out);
      continue;
    }
    if (past_begin > distance_tolerance) {  // begins within: the partition is cut there
      insert(p, {woven_[p].in, in});
      woven_[++p].in = in;
    } else if (past_begin > -distance_tolerance) {  // begins with it: the nearer of both is the begin
      const double ahead = t(woven_[p].in) - t(in);
      if ((p == 0 || t(woven_[p - 1].out) <= t(in)) && ahead > 0 && ahead < distance_tolerance) woven_[p].in = in;
    } else {  // begins before it
      const double reach = t(out) - t(woven_[p].in);
      if (reach < distance_tolerance) {
        if (!(reach < -distance_tolerance)) t(out) = t(woven_[p].in);
        return insert(p, {begin, out});
      }
      const End met = woven_[p].in;
      insert(p, {begin, met});
      begin = met;
      ++p;
    }

    // From here on the partition is the passage's, as far as both go.
    const double past = t(out) - t(woven_[p].out);
    if (past > distance_tolerance) {
      begin = woven_[p].out;
      continue;
    }
    if (!(past > -distance_tolerance)) {
      insert(p, {woven_[p].in, out});
      woven_[p + 1].in = out;
    }
    return;
  }
  woven_.push_back({begin, out});
}

// Moves an end that others share, also those that are finished already.
void Weaver::finish() {
  finished_.clear();
  for (std::size_t p = 0; p < woven_.size(); ++p) {
    const auto [in, out] = woven_[p];
    if (near(t(in), t(out))) t(out) = t(in);
    if (p + 1 < woven_.size()) {
      const double overlap = t(out) - t(woven_[p + 1].in);
      if (near(t(out), t(woven_[p + 1].in))) {
        if (!(std::abs(overlap) < nothing)) t(woven_[p + 1].in) = t(out);
      } else if (overlap > 0) {
        return;
      }
    }
    if (t(out) < distance_tolerance) continue;
    if (!finished_.empty() && near(t(in), t(finished_.back().out)))
      finished_.back().out = out;
    else
      finished_.push_back({in, out});
  }
}

void Weaver::weave(std::vector<Passage>& passages, std::vector<Passage>& partitions) {
  partitions.clear();
  passages_ = passages;
  woven_.clear();
  for (std::uint32_t i = 0; i < passages.size(); ++i) {
    Passage& p = passages[i];
    if (std::abs(p.in) < distance_tolerance) p.in = 0;
    if (std::abs(p.out) < distance_tolerance) p.out = 0;
    if (p.out < farthest_behind || std::isnan(p.in) || std::isnan(p.out) || p.in > p.out) continue;
    weave_passage(i);
  }
  if (woven_.size() == 1 && passages.size() == 1) {  // of a single face: no need of more
    Passage& only = passages[0];
    if (near(only.in, only.out)) only.out = only.in;
    if (!(only.out < distance_tolerance)) partitions.push_back(only);
    return;
  }
  finish();
  for (const auto& [in, out] : finished_) partitions.push_back({t(in), t(out), triangle(in), triangle(out)});
}

}  // namespace plumbline::brlcad
