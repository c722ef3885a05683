#include "case/case_bytes.h"

#include <algorithm>
#include <limits>

#include "case/float_bits.h"
#include "case/precision.h"
#include "case/targets.h"

namespace plumbline {
namespace {

// The nominal domain's exponents: what is found there is an error of rounding, of no other kind. Kernels compute with
// products of up to four coordinates, or differences of coordinates, with sums of such products and their quotients.
// In binary64 a difference that isn't 0 is at least 2^-92, a difference of two products of two at least 2^-236, and
// so on: all stays far within 2^-1022 and 2^1024. In binary32 four coordinates make at least 2^-120 and, with the
// sums, less than 2^88, but a difference may be 2^-53, and three of those underflow: where coordinates near the least
// agree but for their last places. To exclude that as well would leave no binade below 2^-19.
constexpr int end_exponent = 20;
template <class Real>
constexpr int first_exponent = sizeof(Real) == sizeof(float) ? -30 : -40;

enum class Role : unsigned char { coordinate, t_min, t_max, length };

// visit(number, role) of all numbers, in the order of the bytes.
template <class Input, class Visit>
void for_each_number(Input& input, Visit visit) {
  const auto points = [&visit](auto&... vectors) {
    for (auto* p : {&vectors...})
      for (auto* x : {&p->x, &p->y, &p->z}) visit(*x, Role::coordinate);
  };
  auto& [a, b, c] = input.triangle;
  if (input.space == Space::ray) {
    points(input.ray.origin, input.ray.direction, a, b, c);
    visit(input.ray.t_min, Role::t_min);
    visit(input.ray.t_max, Role::t_max);
  } else {
    points(a, b, c);
    visit(input.tolerance, Role::length);
    visit(input.standoff, Role::length);
  }
}

// call.operator()<Real>() for the precision's Real.
template <class Call>
auto at(Precision precision, Call call) {
  return precision == Precision::binary32 ? call.template operator()<float>() : call.template operator()<double>();
}

template <class Real>
using BitsOf = typename FloatFormat<Real>::Bits;

template <class Real>
BitsOf<Real> load(const std::byte* bytes) {
  BitsOf<Real> bits = 0;
  for (std::size_t i = sizeof bits; i-- > 0;) bits = bits << 8 | std::to_integer<BitsOf<Real>>(bytes[i]);
  return bits;
}

template <class Real>
void store(BitsOf<Real> bits, std::byte* bytes) {
  for (std::size_t i = 0; i < sizeof bits; ++i) bytes[i] = static_cast<std::byte>(bits >> 8 * i);
}

// Changes nothing of what is in the domain.
template <class Real>
Real folded(BitsOf<Real> bits, Role role, Domain domain) {
  using F = FloatFormat<Real>;
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  constexpr auto biased = [](int exponent) { return exponent - F::min_exponent + 1; };
  constexpr int first = biased(first_exponent<Real>), count = biased(end_exponent) - first;
  const Real x = from_bits<Real>(bits);
  if (role == Role::t_min || role == Role::t_max) {
    const bool near = role == Role::t_min;
    if (is_nan(x)) return near ? 0 : infinity;
    if (!is_finite(x) && (domain == Domain::full || is_negative(x) == near)) return x;
  }
  if (role == Role::length) bits &= ~F::sign_bit;
  if (is_zero(x)) {
    if (role != Role::length) return x;
    return from_bits<Real>(domain == Domain::full ? 1 : static_cast<BitsOf<Real>>(first) << F::fraction_bits);
  }
  const BitsOf<Real> exponent_bits = bits & F::exponent_mask;
  if (domain == Domain::full)
    return from_bits<Real>(exponent_bits == F::exponent_mask ? bits & ~(F::sign_bit >> 1) : bits);
  const int above = static_cast<int>(exponent_bits >> F::fraction_bits) - first;
  const int exponent = first + (above % count + count) % count;
  return from_bits<Real>((bits & ~F::exponent_mask) | static_cast<BitsOf<Real>>(exponent) << F::fraction_bits);
}

Aiming aiming_of(const FuzzInput& input) { return {.tolerances = {input.tolerance}, .standoff = input.standoff}; }

// A NaN is like any other.
bool same(double p, double q) { return to_bits(p) == to_bits(q) || (is_nan(p) && is_nan(q)); }
bool same(const Vec3& p, const Vec3& q) { return same(p.x, q.x) && same(p.y, q.y) && same(p.z, q.z); }
bool same(const Ray& p, const Ray& q) {
  return same(p.origin, q.origin) && same(p.direction, q.direction) && same(p.t_min, q.t_min) &&
         same(p.t_max, q.t_max);
}

}  // namespace

std::size_t input_size(Space space, Precision precision) {
  return (space == Space::ray ? 17 : 12) * at(precision, []<class Real>() { return sizeof(Real); });
}

FuzzInput decode(std::span<const std::byte> bytes, Space space, Precision precision, Domain domain) {
  FuzzInput input;
  input.space = space;
  input.precision = precision;
  at(precision, [&]<class Real>() {
    const std::byte* next = bytes.data();
    for_each_number(input, [&](double& x, Role role) {
      x = static_cast<double>(folded<Real>(load<Real>(next), role, domain));
      next += sizeof(Real);
    });
    if (space == Space::target) input.target = static_cast<unsigned>(load<Real>(next) % targets_of_a_triangle);
  });
  if (input.target < first_target_with_tolerance) input.tolerance = 0;
  return input;
}

void encode(const FuzzInput& input, std::span<std::byte> bytes) {
  at(input.precision, [&]<class Real>() {
    std::byte* next = bytes.data();
    for_each_number(input, [&](double x, Role) {
      store<Real>(to_bits(static_cast<Real>(x)), next);
      next += sizeof(Real);
    });
    if (input.space == Space::target) store<Real>(input.target, next);
  });
}

bool in_domain(const FuzzInput& input, Domain domain) {
  std::array<std::byte, longest_input> one, other;
  const std::size_t size = input_size(input.space, input.precision);
  encode(input, std::span(one).first(size));
  const FuzzInput back = decode(std::span(one).first(size), input.space, input.precision, domain);
  encode(back, std::span(other).first(size));
  return back == input && std::equal(one.begin(), one.begin() + size, other.begin());  // == takes -0 for 0
}

Ray ray_of(const FuzzInput& input) {
  if (input.space == Space::ray) return input.ray;
  std::array<Ray, targets_of_a_triangle> rays;
  aim_rays(input.triangle, aiming_of(input), rays);
  return at_precision(rays[input.target], input.precision);
}

Case to_case(const FuzzInput& input) {
  Case made;
  made.precision = input.precision;
  made.bag.triangles = {input.triangle};
  made.ray = ray_of(input);
  if (input.space == Space::target) made.aim = aims(aiming_of(input))[input.target];
  return made;
}

std::optional<FuzzInput> from_case(const Case& what, Space space, Precision precision) {
  const Bag& bag = what.bag;
  if (bag.triangles.size() != 1 || bag != Bag{.triangles = bag.triangles}) return std::nullopt;
  FuzzInput made;
  made.space = space;
  made.precision = precision;
  made.triangle = bag.triangles.front();
  if (space == Space::ray) {
    made.ray = what.ray;
    return in_domain(made, Domain::full) ? std::optional(made) : std::nullopt;
  }
  if (!what.aim) return std::nullopt;
  made.tolerance = what.aim->tolerance.value_or(0);
  made.standoff = what.aim->standoff;
  const std::vector<Aim> list = aims(aiming_of(made));
  for (; made.target < targets_of_a_triangle; ++made.target)
    if (list[made.target] == *what.aim && in_domain(made, Domain::full) && same(ray_of(made), what.ray)) return made;
  return std::nullopt;
}

}  // namespace plumbline
