#include "analysis/bag_shrink.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "analysis/ask.h"
#include "analysis/hard_steps.h"
#include "analysis/shrink.h"
#include "analysis/simpler_number.h"
#include "case/float_bits.h"
#include "case/precision.h"
#include "case/random.h"
#include "oracle/boundary.h"

namespace plumbline {
namespace {

constexpr double gross_ulps = 1024;       // from which on an answer is no matter of rounding
constexpr std::size_t few_triangles = 4;  // up to which a ray is put back onto its edge
constexpr double infinity = std::numeric_limits<double>::infinity();

// A case whose triangles share their vertices, so that moving one keeps them together.
struct SharedBag {
  Case rest;  // no triangles
  std::vector<Vec3> vertices;
  std::vector<std::array<std::size_t, 3>> triangles;

  explicit SharedBag(const Case& what) : rest(what) {
    rest.bag.triangles.clear();
    std::map<std::tuple<double, double, double>, std::size_t> seen;
    const auto index = [&](const Vec3& v) {
      const auto [it, is_new] = seen.emplace(std::tuple(v.x, v.y, v.z), vertices.size());
      if (is_new) vertices.push_back(v);
      return it->second;
    };
    for (const Triangle& t : what.bag.triangles) {
      const std::size_t a = index(t.a), b = index(t.b), c = index(t.c);
      triangles.push_back({a, b, c});
    }
  }

  Case to_case() const {
    Case what = rest;
    for (const auto& [a, b, c] : triangles) what.bag.triangles.push_back({vertices[a], vertices[b], vertices[c]});
    return what;
  }

  std::vector<double*> numbers() {
    std::vector<double*> list;
    const auto add = [&](Vec3& v) { list.insert(list.end(), {&v.x, &v.y, &v.z}); };
    for (Vec3& v : vertices) add(v);
    add(rest.ray.origin);
    add(rest.ray.direction);
    list.insert(list.end(), {&rest.ray.t_min, &rest.ray.t_max});
    return list;
  }

  void round() {
    for (double* number : numbers()) *number = at_precision(*number, rest.precision);
  }

  unsigned weight() {
    unsigned sum = 0;
    for (const double* number : numbers()) sum += plumbline::weight(*number);
    return sum;
  }
};

class Shrinker {
 public:
  Shrinker(const Case& asked, const Tracer& tracer)
      : tracer_(tracer), best_(put_at(asked, tracer.info().contract.precision)) {
    best_.precision = tracer.info().contract.precision;
  }

  std::optional<ShrunkBag> run() {
    ShrunkBag r;
    r.before = examine_bag(tracer_, best_);
    const auto found = signature(r.before);
    if (!found) return std::nullopt;
    wanted_ = *found;
    gross_ = r.before.judgement.ulps >= gross_ulps;
    r.bits_before = significant_bits(best_);
    only_those_met(r.before);
    take_triangles_away();
    if (wanted_ != death_signature) {
      if (best_.bag.triangles.size() == 1) simplify_alone();
      simplify_numbers();
    }
    r.what = best_;
    r.after = examine_bag(tracer_, best_);
    r.bits_after = significant_bits(best_);
    r.tries = tries_;
    return r;
  }

 private:
  bool same_finding(const Case& what) {
    ++tries_;
    const BagExamination e = examine_bag(tracer_, what);
    return signature(e) == wanted_ && (!gross_ || e.judgement.ulps >= gross_ulps);
  }

  bool take(const Case& what) {
    if (!same_finding(what)) return false;
    best_ = what;
    return true;
  }

  // A guess that is mostly right, and saves many steps.
  void only_those_met(const BagExamination& e) {
    Case few = best_;
    few.bag.triangles.clear();
    for (std::uint32_t i = 0; i < best_.bag.triangles.size(); ++i) {
      const bool met = std::ranges::count(e.truth.hits, i, &BagHit::triangle) != 0;
      if (met || (e.answer.outcome == Outcome::hit && e.answer.triangle == i))
        few.bag.triangles.push_back(best_.bag.triangles[i]);
    }
    if (!few.bag.triangles.empty()) take(few);
  }

  void take_triangles_away() {
    for (std::size_t chunk = std::max<std::size_t>(best_.bag.triangles.size() / 2, 1);; chunk /= 2) {
      for (bool taken = true; taken;) {
        taken = false;
        for (std::size_t first = 0; first < best_.bag.triangles.size() && best_.bag.triangles.size() > 1;) {
          Case fewer = best_;
          const auto begin = fewer.bag.triangles.begin() + static_cast<std::ptrdiff_t>(first);
          const std::size_t count = std::min(chunk, best_.bag.triangles.size() - first);
          fewer.bag.triangles.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
          if (!fewer.bag.triangles.empty() && take(fewer))
            taken = true;
          else
            first += chunk;
        }
      }
      if (chunk == 1) return;
    }
  }

  bool take(SharedBag simpler) {
    simpler.round();
    if (!(simpler.weight() < SharedBag(best_).weight())) return false;
    return take(simpler.to_case());
  }

  bool move_to_origin() {
    bool moved = false;
    SharedBag here(best_);
    std::vector<Vec3> places = here.vertices;
    places.push_back(here.rest.ray.origin);
    for (const Vec3& place : places) {
      SharedBag there(best_);
      const auto shift = [&](Vec3& v) { v = {v.x - place.x, v.y - place.y, v.z - place.z}; };
      for (Vec3& v : there.vertices) shift(v);
      shift(there.rest.ray.origin);
      moved = take(there) || moved;
    }
    return moved;
  }

  bool simplify_number(std::size_t i) {
    const auto with = [&](double value) {
      SharedBag simpler(best_);
      *simpler.numbers()[i] = value;
      return take(simpler);
    };
    SharedBag now(best_);
    const auto numbers = now.numbers();
    const double value = *numbers[i];
    if (i + 2 >= numbers.size()) {  // an end of the range
      const double usual = i + 2 == numbers.size() ? 0 : infinity;
      if (value != usual) {
        Case open = best_;
        (i + 2 == numbers.size() ? open.ray.t_min : open.ray.t_max) = usual;
        if (take(open)) return true;
      }
    }
    if (is_zero(value) || !is_finite(value)) return false;
    if (with(0) || with(1) || with(-1) || with(-value)) return true;
    const int bits = static_cast<int>(plumbline::significant_bits(value));
    for (int fewer = 1; fewer < bits; ++fewer)
      for (const int direction : {0, -1, 1})
        if (with(rounded_to_bits(value, fewer, direction))) return true;
    return false;
  }

  // One triangle has a stronger shrinker, which knows how to put a ray back onto a knife's edge.
  void simplify_alone() {
    const auto input = from_case(best_, Space::ray, best_.precision);
    const auto shrunk = input ? shrink(*input, tracer_, gross_ ? Keep::worst : Keep::simple) : std::nullopt;
    if (!shrunk) return;
    Case simpler = best_;
    simpler.bag.triangles = {shrunk->input.triangle};
    simpler.ray = shrunk->input.ray;
    take(simpler);
  }

  // Simplifies some numbers hard, and solves one coordinate to put the ray back on a boundary of a triangle, or a few
  // ulps beside.
  bool repair() {
    bool any = false;
    for (int i = 0; i < 4000; ++i) {
      SharedBag x(best_);
      const unsigned weight = x.weight();
      const auto numbers = x.numbers();
      simplify_hard(std::span(numbers).first(numbers.size() - 2), digits(best_.precision), random_);
      x.round();
      const auto& [a, b, c] = x.triangles[random_.below(x.triangles.size())];
      const std::size_t at = random_.below(15);
      // The solver counts the ray's coordinates first.
      const std::size_t corner = std::array{a, b, c}[at < 6 ? 0 : at / 3 - 2], rays = 3 * x.vertices.size();
      double& solved = *numbers[at < 6 ? rays + at : 3 * corner + at % 3];
      solved = 0;
      if (!(x.weight() < weight)) continue;
      const auto decision = static_cast<Decision>(random_.below(6));
      const auto root = boundary({x.vertices[a], x.vertices[b], x.vertices[c]}, x.rest.ray, decision,
                                 static_cast<int>(at), best_.precision);
      if (!root) continue;
      const auto take_it = [&](double value) {
        solved = value;
        return take(x);
      };
      any = take_near(
                *root, best_.precision, [] { return 0; }, take_it) ||
            any;
    }
    return any;
  }

  void simplify_numbers() {
    constexpr int rounds = 20;
    for (int round = 0; round < rounds; ++round) {
      bool simpler = move_to_origin();
      const std::size_t count = SharedBag(best_).numbers().size();
      for (std::size_t i = 0; i < count && i < SharedBag(best_).numbers().size(); ++i)
        simpler = simplify_number(i) || simpler;
      if (best_.bag.triangles.size() <= few_triangles) simpler = repair() || simpler;
      if (!simpler) return;
    }
  }

  const Tracer& tracer_;
  BagSignature wanted_;
  bool gross_ = false;  // and is to stay so
  Case best_;
  Random random_{7, 0};
  std::uint64_t tries_ = 0;
};

}  // namespace

std::optional<ShrunkBag> shrink_bag(const Case& asked, const Tracer& tracer) { return Shrinker(asked, tracer).run(); }

unsigned significant_bits(const Case& what) {
  SharedBag bag(what);
  unsigned sum = 0;
  for (const double* number : bag.numbers())
    if (is_finite(*number)) sum += significant_bits(*number);
  return sum;
}

}  // namespace plumbline
