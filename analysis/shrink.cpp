#include "analysis/shrink.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "analysis/hard_steps.h"
#include "analysis/simpler_number.h"
#include "case/float_bits.h"
#include "case/precision.h"
#include "case/random.h"
#include "case/targets.h"
#include "oracle/boundary.h"

namespace plumbline {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// The numbers of an input: those of points, then those alone.
struct Numbers {
  explicit Numbers(FuzzInput& x) {
    for (Vec3* p : {&x.triangle.a, &x.triangle.b, &x.triangle.c}) add(*p);
    if (x.space == Space::ray) {
      for (Vec3* p : {&x.ray.origin, &x.ray.direction}) add(*p);
      coordinates = size;
      for (double* bound : {&x.ray.t_min, &x.ray.t_max}) all[size++] = bound;
    } else {
      coordinates = size;
      for (double* length : {&x.tolerance, &x.standoff}) all[size++] = length;
    }
  }
  double& operator[](std::size_t i) { return *all[i]; }
  Numbers(const Numbers&) = delete;

  std::array<double*, 17> all{};  ///< a, b, c, and in the ray space origin, direction
  std::size_t size = 0, coordinates = 0;

 private:
  void add(Vec3& p) {
    for (double* c : {&p.x, &p.y, &p.z}) all[size++] = c;
  }
};

struct Simplicity {
  unsigned weight = 0, ones = 0, bits = 0;

  explicit Simplicity(const FuzzInput& input) {
    FuzzInput x = input;
    Numbers numbers(x);
    for (std::size_t i = 0; i < numbers.size; ++i) {
      const double v = numbers[i];
      weight += plumbline::weight(v);
      if (std::abs(v) == inf) continue;
      bits += plumbline::significant_bits(v);
      ones += static_cast<unsigned>(std::popcount(significand(v)));
    }
  }
  bool operator<(const Simplicity& y) const { return weight != y.weight ? weight < y.weight : ones < y.ones; }
};

class Shrinker {
 public:
  Shrinker(const FuzzInput& input, const Tracer& tracer, Keep keep)
      : examiner_(tracer),
        keep_(keep),
        domain_(in_domain(input, Domain::nominal) ? Domain::nominal : Domain::full),
        best_(input),
        simplicity_(input) {}

  std::optional<Shrunk> run() {
    Shrunk r;
    r.before = examine(best_);
    const auto found = signature(r.before, wish());
    if (!found) return std::nullopt;
    wanted_ = *found;
    severity_ = r.before.severity_ulps();
    r.bits_before = simplicity_.bits;
    constexpr int rounds = 40;
    for (int i = 0; i < rounds && (passes() || repairs() || anew() || chances()); ++i) {
    }
    r.input = best_;
    r.after = examine(best_);
    r.bits_after = simplicity_.bits;
    r.tries = tries_;
    return r;
  }

 private:
  Examination examine(const FuzzInput& x) { return examiner_.examine(x.triangle, ray_of(x)); }
  Wish wish() const {
    if (best_.space == Space::ray) return Wish::none;
    return aims({.tolerances = {1}})[best_.target].wish;
  }
  int digits() const { return plumbline::digits(best_.precision); }

  bool same_finding(const FuzzInput& x) {
    ++tries_;
    const Examination e = examine(x);
    const auto s = signature(e, wish());
    if (!s || s->kind != wanted_.kind || s->element != wanted_.element || s->rejection != wanted_.rejection ||
        s->boundary != wanted_.boundary || s->lucky != wanted_.lucky)
      return false;
    switch (keep_) {
      case Keep::simple:
        return true;
      case Keep::nominal:
        return s->conditioning == wanted_.conditioning;
      case Keep::worst:
        return *s == wanted_ && e.severity_ulps() >= severity_ / 2;
    }
    return false;
  }

  // Takes the case if it is simpler and the same finding.
  bool offer(const FuzzInput& x) {
    if (x.space == Space::ray && x.ray.direction == Vec3{}) return false;
    const Simplicity simplicity(x);
    if (!(simplicity < simplicity_) || !in_domain(x, domain_) || !same_finding(x)) return false;
    best_ = x;
    simplicity_ = simplicity;
    return true;
  }
  // change(numbers) of the best so far, rounded to the precision.
  template <class Change>
  bool with(Change change) {
    FuzzInput x = best_;
    Numbers numbers(x);
    change(numbers);
    for (std::size_t i = 0; i < numbers.size; ++i) numbers[i] = at_precision(numbers[i], x.precision);
    return offer(x);
  }

  // One round of plain simplifications, from the whole to the single number.
  bool passes() {
    bool any = false;
    const auto try_ = [&](auto change) { any |= with(change); };
    const std::size_t points = best_.space == Space::ray ? 5 : 3, places = std::min<std::size_t>(points, 4);
    if (best_.space == Space::ray) {
      try_([](Numbers& n) { n[15] = 0, n[16] = inf; });
      try_([](Numbers& n) { n[15] = 0; });
      try_([](Numbers& n) { n[16] = inf; });
    }
    // A vertex, or the origin, to 0; along one axis alone; scales; mirrors; an axis to nothing.
    for (std::size_t p = 0; p < places; ++p)
      for (std::size_t axes = 1; axes < 8; ++axes)
        try_([&](Numbers& n) {
          const std::array<double, 3> shift = {n[3 * p], n[3 * p + 1], n[3 * p + 2]};
          for (std::size_t i = 0; i < 3 * places; ++i)
            if ((axes >> i % 3 & 1) != 0) n[i] -= shift[i % 3];
        });
    for (int e = -24; e <= 24; ++e) {
      const double scale = std::ldexp(1.0, e);
      try_([&](Numbers& n) {
        for (std::size_t i = 0; i < 3 * places; ++i) n[i] *= scale;
      });
      if (points == 5)
        try_([&](Numbers& n) {
          for (std::size_t i = 12; i < 15; ++i) n[i] *= scale;
        });
      for (std::size_t axis = 0; axis < 3; ++axis)
        try_([&](Numbers& n) {
          for (std::size_t i = axis; i < n.coordinates; i += 3) n[i] *= scale;
        });
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const double factor : {-1.0, 0.0})
        try_([&](Numbers& n) {
          for (std::size_t i = axis; i < n.coordinates; i += 3) n[i] = factor == 0 ? 0 : -n[i];
        });
    // All numbers, then each point, to fewer bits, or to a grid.
    for (int bits = 1; bits < digits(); ++bits)
      for (int direction = -1; direction <= 1; ++direction)
        try_([&](Numbers& n) {
          for (std::size_t i = 0; i < n.coordinates; ++i) n[i] = rounded_to_bits(n[i], bits, direction);
        });
    for (int e = 10; e >= -30; --e)
      try_([&](Numbers& n) {
        for (std::size_t i = 0; i < n.coordinates; ++i) n[i] = std::ldexp(std::nearbyint(std::ldexp(n[i], -e)), e);
      });
    for (std::size_t p = 0; p < points; ++p)
      for (int bits = 1; bits < digits(); ++bits)
        try_([&](Numbers& n) {
          for (std::size_t i = 3 * p; i < 3 * p + 3; ++i) n[i] = rounded_to_bits(n[i], bits, 0);
        });
    for (std::size_t i = 0; i < 3 * points + 2; ++i) number(i, any);
    return any;
  }

  void number(std::size_t i, bool& any) {
    const auto try_ = [&](auto change) { any |= with([&](Numbers& n) { n[i] = change(n[i]); }); };
    for (const double v : {0.0, 1.0, -1.0, 2.0, -2.0, 0.5, -0.5, 3.0, 4.0}) try_([v](double) { return v; });
    for (std::size_t j = 0; j < 15; ++j)
      any |= with([&](Numbers& n) {
        if (j < n.coordinates) n[i] = n[j];
      });
    for (int bits = 1; bits < digits(); ++bits)
      for (int direction = -1; direction <= 1; ++direction)
        try_([&](double v) { return rounded_to_bits(v, bits, direction); });
    for (int bit = 0; bit < digits() - 1; ++bit)  // one bit off
      try_([&](double v) { return from_bits<double>(to_bits(v) & ~(std::uint64_t{1} << (52 - bit))); });
    try_([](double v) { return std::trunc(v); });
    try_([](double v) { return std::nearbyint(v); });
    try_([](double v) { return -v; });
    for (const int e : {-8, -4, -2, -1, 1, 2, 4, 8}) try_([e](double v) { return std::ldexp(v, e); });
  }

  // Simplifies some numbers hard, and solves one coordinate to be back on a boundary, or a few ulps beside.
  bool repairs() {
    bool any = false;
    for (int i = 0; i < 4000; ++i)
      any |= repaired([this](Numbers& n) { simplify_hard(std::span(n.all).first(n.coordinates), digits(), random_); });
    return any;
  }
  // The same with many numbers, or all, that have nothing to do with the case: small integers and powers of two.
  bool anew() {
    bool any = false;
    for (int i = 0; i < 16000; ++i)
      any |= repaired([this](Numbers& n) {
        const auto kept = random_.below(4);
        for (std::size_t k = 0; k < n.coordinates; ++k)
          if (random_.below(4) >= kept) n[k] = plain_number(digits(), random_);
      });
    return any;
  }
  template <class Change>
  bool repaired(Change change) {
    if (best_.space == Space::target) return false;
    FuzzInput x = best_;
    Numbers n(x);
    change(n);
    for (std::size_t k = 0; k < n.size; ++k) n[k] = at_precision(n[k], x.precision);
    const std::size_t at = random_.below(15);
    FuzzInput least = x;
    *Numbers(least).all[at] = 0;
    if (!(Simplicity(least) < simplicity_)) return false;
    const auto decision = static_cast<Decision>(random_.below(6));
    // The solver counts the ray's coordinates first.
    const auto root = boundary(x.triangle, x.ray, decision, static_cast<int>(at < 9 ? at + 6 : at - 9), x.precision);
    return root && take_near(
                       *root, x.precision, [this] { return static_cast<int>(random_.below(3)) - 1; },
                       [&](double value) {
                         n[at] = value;
                         return offer(x);
                       });
  }
  // A few numbers changed at once, by chance.
  bool chances() {
    bool any = false;
    for (int i = 0; i < 2000; ++i)
      any |= with([&](Numbers& n) {
        for (auto k = 1 + random_.below(3); k > 0; --k) {
          double& v = n[random_.below(n.coordinates)];
          const int bits = 1 + static_cast<int>(random_.below(12));
          switch (random_.below(4)) {
            case 0:
              v = plain_number(digits(), random_);
              break;
            case 1:
              v = rounded_to_bits(v, 2 * bits, static_cast<int>(random_.below(3)) - 1);
              break;
            case 2:
              v = n[random_.below(n.coordinates)];
              break;
            default:
              v = rounded_to_bits(v, bits, 0) +
                  std::ldexp(static_cast<double>(random_.integer(-1, 1)), std::ilogb(is_zero(v) ? 1 : v) - bits + 1);
          }
        }
      });
    return any;
  }

  Examiner examiner_;
  Keep keep_;
  Domain domain_;
  FuzzInput best_;
  Simplicity simplicity_;
  Signature wanted_;
  double severity_ = 0;
  Random random_{7, 0};
  std::uint64_t tries_ = 0;
};

}  // namespace

std::optional<Shrunk> shrink(const FuzzInput& input, const Tracer& tracer, Keep keep) {
  return Shrinker(input, tracer, keep).run();
}

unsigned significant_bits(const FuzzInput& input) { return Simplicity(input).bits; }

}  // namespace plumbline
