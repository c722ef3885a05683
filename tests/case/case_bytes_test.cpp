#include "case/case_bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <random>

#include "case/float_bits.h"
#include "case/precision.h"
#include "case/targets.h"

namespace plumbline {
namespace {

using Bytes = std::vector<std::byte>;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array spaces = {Space::ray, Space::target};
constexpr std::array precisions = {Precision::binary32, Precision::binary64};
constexpr std::array domains = {Domain::nominal, Domain::full};

Bytes encoded(const FuzzInput& input) {
  Bytes bytes(input_size(input.space, input.precision));
  encode(input, bytes);
  return bytes;
}

// The bits of number `at`, as the bytes have them.
std::uint64_t number(const Bytes& bytes, Precision precision, std::size_t at) {
  const std::size_t size = precision == Precision::binary32 ? 4 : 8;
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) bits |= std::to_integer<std::uint64_t>(bytes[at * size + i]) << 8 * i;
  return bits;
}
void put(Bytes& bytes, Precision precision, std::size_t at, std::uint64_t bits) {
  const std::size_t size = precision == Precision::binary32 ? 4 : 8;
  for (std::size_t i = 0; i < size; ++i) bytes[at * size + i] = static_cast<std::byte>(bits >> 8 * i);
}
std::uint64_t bits_of(double x, Precision precision) {
  return precision == Precision::binary32 ? to_bits(static_cast<float>(x)) : to_bits(x);
}

// All numbers 1, but this one.
FuzzInput decode_one(Space space, Precision precision, Domain domain, std::size_t at, std::uint64_t bits) {
  Bytes bytes(input_size(space, precision));
  for (std::size_t i = 0; i < (space == Space::ray ? 17 : 12); ++i) put(bytes, precision, i, bits_of(1, precision));
  put(bytes, precision, at, bits);
  return decode(bytes, space, precision, domain);
}

FuzzInput ray_input(Precision precision = Precision::binary64) {
  return {.precision = precision,
          .triangle = {{7, 8, 9}, {10, 11, 12}, {13, 14, 15}},
          .ray = {{1, 2, 3}, {4, 5, 6}, 16, 17}};
}
FuzzInput target_input(unsigned target, Precision precision = Precision::binary64) {
  return {.space = Space::target,
          .precision = precision,
          .triangle = {{1, 2, 3}, {4, 5, 6}, {7, 8, -9}},
          .ray = {},
          .tolerance = target < 10 ? 0 : 0x1p-4,
          .standoff = 11,
          .target = target};
}

TEST(CaseBytes, Sizes) {
  EXPECT_EQ(input_size(Space::ray, Precision::binary32), 68u);
  EXPECT_EQ(input_size(Space::ray, Precision::binary64), 136u);
  EXPECT_EQ(input_size(Space::target, Precision::binary32), 48u);
  EXPECT_EQ(input_size(Space::target, Precision::binary64), 96u);
}

TEST(CaseBytes, NumbersAreInOrderAndLittleEndian) {
  for (const Precision precision : precisions) {
    const Bytes ray = encoded(ray_input(precision));
    for (std::size_t i = 0; i < 17; ++i)
      EXPECT_EQ(number(ray, precision, i), bits_of(static_cast<double>(i + 1), precision)) << i;
    const Bytes target = encoded(target_input(27, precision));
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_EQ(number(target, precision, i), bits_of(static_cast<double>(i + 1), precision)) << i;
    EXPECT_EQ(number(target, precision, 8), bits_of(-9, precision));
    EXPECT_EQ(number(target, precision, 9), bits_of(0x1p-4, precision));
    EXPECT_EQ(number(target, precision, 10), bits_of(11, precision));
    EXPECT_EQ(number(target, precision, 11), 27u);
  }
  FuzzInput input = ray_input(Precision::binary32);
  input.ray.origin.x = -0x1.020304p+0;  // 0xbf810182
  const Bytes bytes = encoded(input);
  EXPECT_EQ((std::vector(bytes.begin(), bytes.begin() + 4)),
            (Bytes{std::byte{0x82}, std::byte{0x01}, std::byte{0x81}, std::byte{0xbf}}));
}

TEST(CaseBytes, DecodesWhatIsEncoded) {
  for (const Precision precision : precisions)
    for (const Domain domain : domains) {
      const FuzzInput ray = ray_input(precision);
      EXPECT_EQ(decode(encoded(ray), Space::ray, precision, domain), ray);
      for (unsigned target = 0; target < 28; ++target) {
        const FuzzInput input = target_input(target, precision);
        EXPECT_EQ(decode(encoded(input), Space::target, precision, domain), input);
      }
    }
}

template <class Real>
class Folding : public testing::Test {
 protected:
  static constexpr Precision precision = sizeof(Real) == 4 ? Precision::binary32 : Precision::binary64;
  static constexpr int least = sizeof(Real) == 4 ? -30 : -40;
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();
  static constexpr std::size_t t_min = 15, t_max = 16;  // of the ray space

  static Real coordinate(Real x, Domain domain) {
    return static_cast<Real>(decode_one(Space::ray, precision, domain, 0, to_bits(x)).ray.origin.x);
  }
  static Real near(Real x, Domain domain) {
    return static_cast<Real>(decode_one(Space::ray, precision, domain, t_min, to_bits(x)).ray.t_min);
  }
  static Real far(Real x, Domain domain) {
    return static_cast<Real>(decode_one(Space::ray, precision, domain, t_max, to_bits(x)).ray.t_max);
  }
  static Real standoff(Real x, Domain domain) {
    return static_cast<Real>(decode_one(Space::target, precision, domain, 10, to_bits(x)).standoff);
  }
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Folding, Reals);

TYPED_TEST(Folding, EndsOfTheNominalDomain) {
  using T = TestFixture;
  constexpr auto nominal = Domain::nominal;
  const auto power = [](int e) { return std::ldexp(TypeParam{1}, e); };
  const auto inside = [&](TypeParam x) { EXPECT_EQ(to_bits(T::coordinate(x, nominal)), to_bits(x)) << x; };
  for (const TypeParam sign : {TypeParam{1}, TypeParam{-1}}) {
    inside(sign * 0);
    inside(sign * power(T::least));
    inside(sign * step_ulps(power(20), -1));
    EXPECT_EQ(T::coordinate(sign * step_ulps(power(T::least), -1), nominal), sign * step_ulps(power(20), -1));
    EXPECT_EQ(T::coordinate(sign * power(20), nominal), sign * power(T::least));
  }
}

TYPED_TEST(Folding, EveryExponentLandsInTheNominalDomainSpreadEvenly) {
  using T = TestFixture;
  using F = FloatFormat<TypeParam>;
  using Bits = typename F::Bits;
  const auto last = static_cast<int>(F::exponent_mask >> F::fraction_bits);
  std::map<int, int> landed;
  for (int biased = 0; biased <= last; ++biased)
    for (const Bits sign : {Bits{0}, F::sign_bit})
      for (const Bits fraction : {Bits{0}, Bits{1}, F::fraction_mask}) {
        const Bits bits = sign | static_cast<Bits>(biased) << F::fraction_bits | fraction;
        const TypeParam x = from_bits<TypeParam>(bits), y = T::coordinate(x, Domain::nominal);
        if (is_zero(x)) {
          EXPECT_EQ(to_bits(y), bits);
          continue;
        }
        EXPECT_GE(std::abs(y), std::ldexp(TypeParam{1}, T::least));
        EXPECT_LT(std::abs(y), 0x1p20);
        EXPECT_EQ(to_bits(y) & ~F::exponent_mask, sign | fraction) << biased;
        if (std::abs(x) >= std::ldexp(TypeParam{1}, T::least) && std::abs(x) < 0x1p20) {
          EXPECT_EQ(to_bits(y), bits);
        }
        if (fraction == 1 && sign == 0) ++landed[std::ilogb(y)];
      }
  ASSERT_EQ(landed.size(), static_cast<std::size_t>(20 - T::least));
  const int fair = (last + 1) / (20 - T::least);
  for (const auto& [exponent, count] : landed) EXPECT_TRUE(count == fair || count == fair + 1) << exponent;
}

TYPED_TEST(Folding, FullDomainTakesAllThatIsFinite) {
  using T = TestFixture;
  using F = FloatFormat<TypeParam>;
  using Bits = typename F::Bits;
  const auto last = static_cast<int>(F::exponent_mask >> F::fraction_bits);
  for (int biased = 0; biased <= last; ++biased)
    for (const Bits sign : {Bits{0}, F::sign_bit})
      for (const Bits fraction : {Bits{0}, Bits{1}, F::fraction_mask}) {
        const Bits bits = sign | static_cast<Bits>(biased) << F::fraction_bits | fraction;
        const Bits expected = biased < last ? bits : bits & ~(F::sign_bit >> 1);
        EXPECT_EQ(to_bits(T::coordinate(from_bits<TypeParam>(bits), Domain::full)), expected) << biased;
      }
  EXPECT_EQ(T::coordinate(-T::infinity, Domain::full), -1);
}

TYPED_TEST(Folding, Bounds) {
  using T = TestFixture;
  const auto not_a_number = std::numeric_limits<TypeParam>::quiet_NaN();
  for (const Domain domain : domains) {
    EXPECT_EQ(to_bits(T::near(not_a_number, domain)), to_bits(TypeParam{0}));
    EXPECT_EQ(T::far(-not_a_number, domain), T::infinity);
    EXPECT_EQ(T::near(-T::infinity, domain), -T::infinity);
    EXPECT_EQ(T::far(T::infinity, domain), T::infinity);
    for (const TypeParam x : {TypeParam{0}, -TypeParam{0}, TypeParam{-3}}) {
      EXPECT_EQ(to_bits(T::near(x, domain)), to_bits(x));
      EXPECT_EQ(to_bits(T::far(x, domain)), to_bits(x));
    }
  }
  EXPECT_EQ(T::near(T::infinity, Domain::full), T::infinity);
  EXPECT_EQ(T::far(-T::infinity, Domain::full), -T::infinity);
  EXPECT_EQ(T::near(T::infinity, Domain::nominal), T::coordinate(T::infinity, Domain::nominal));
  EXPECT_EQ(T::far(-T::infinity, Domain::nominal), T::coordinate(-T::infinity, Domain::nominal));
  EXPECT_EQ(T::far(0x1p20, Domain::nominal), std::ldexp(TypeParam{1}, T::least));
}

TYPED_TEST(Folding, LengthsArePositive) {
  using T = TestFixture;
  for (const TypeParam zero : {TypeParam{0}, -TypeParam{0}}) {
    EXPECT_EQ(T::standoff(zero, Domain::nominal), std::ldexp(TypeParam{1}, T::least));
    EXPECT_EQ(T::standoff(zero, Domain::full), std::numeric_limits<TypeParam>::denorm_min());
  }
  for (const Domain domain : domains) EXPECT_EQ(T::standoff(-5, domain), 5);
  EXPECT_EQ(T::standoff(-T::infinity, Domain::full), 1);
  EXPECT_EQ(T::standoff(0x1p20, Domain::nominal), std::ldexp(TypeParam{1}, T::least));
}

TEST(CaseBytes, TargetsCountModulo28) {
  for (const Precision precision : precisions) {
    for (unsigned i = 0; i < 100; ++i)
      EXPECT_EQ(decode_one(Space::target, precision, Domain::nominal, 11, i).target, i % 28);
    const std::uint64_t most = precision == Precision::binary32 ? 0xffffffff : 0xffffffffffffffff;
    EXPECT_EQ(decode_one(Space::target, precision, Domain::nominal, 11, most).target, most % 28);
  }
}

TEST(CaseBytes, OnlyTargetsAtAToleranceHaveOne) {
  for (unsigned i = 0; i < 28; ++i) {
    const FuzzInput input = decode_one(Space::target, Precision::binary64, Domain::nominal, 11, i);
    EXPECT_EQ(input.tolerance, i < 10 ? 0 : 1) << i;
    EXPECT_EQ(to_case(input).aim->tolerance.has_value(), i >= 10) << i;
  }
}

TEST(CaseBytes, RaysAreThoseOfTheReport) {
  const Aiming aiming{.tolerances = {0x1p-4}, .standoff = 11};
  const std::vector<Aim> aimed = aims(aiming);
  ASSERT_EQ(aimed.size(), 28u);
  std::vector<Ray> rays(28);
  aim_rays(target_input(0).triangle, aiming, rays);
  for (unsigned i = 0; i < 28; ++i) {
    EXPECT_EQ(ray_of(target_input(i)), rays[i]) << i;
    EXPECT_EQ(ray_of(target_input(i, Precision::binary32)), at_precision(rays[i], Precision::binary32)) << i;
    EXPECT_NE(ray_of(target_input(i, Precision::binary32)), rays[i]) << i;
    EXPECT_EQ(to_case(target_input(i)).aim, aimed[i]) << i;
  }
  EXPECT_EQ(ray_of(ray_input()), ray_input().ray);
}

// What the header says of a number, without decode.
bool may_be_nominal(double x, Precision precision) {
  const double least = precision == Precision::binary32 ? 0x1p-30 : 0x1p-40;
  return x == 0 || (std::abs(x) >= least && std::abs(x) < 0x1p20);
}

TEST(CaseBytes, AnyBytesMeanAnInputOfTheDomainThatSurvives) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  for (const Space space : spaces)
    for (const Precision precision : precisions)
      for (int i = 0; i < 100'000; ++i) {
        Bytes bytes(input_size(space, precision));
        for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
        for (const Domain domain : domains) {
          const FuzzInput input = decode(bytes, space, precision, domain);
          ASSERT_TRUE(in_domain(input, domain));
          ASSERT_TRUE(in_domain(input, Domain::full));
          const Bytes canonical = encoded(input);
          const FuzzInput back = decode(canonical, space, precision, domain);
          ASSERT_EQ(back, input);
          ASSERT_EQ(encoded(back), canonical);
          const auto& [a, b, c] = input.triangle;
          for (const Vec3& p : {input.ray.origin, input.ray.direction, a, b, c})
            for (const double x : {p.x, p.y, p.z})
              ASSERT_TRUE(domain == Domain::full ? is_finite(x) : may_be_nominal(x, precision)) << x;
        }
      }
}

TEST(CaseBytes, AnyInputSurvivesAsACase) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  for (const Space space : spaces)
    for (const Precision precision : precisions)
      for (const Domain domain : domains)
        for (int i = 0; i < 10'000; ++i) {
          Bytes bytes(input_size(space, precision));
          for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
          const FuzzInput input = decode(bytes, space, precision, domain);
          const Case made = to_case(input);
          const auto back = from_case(made, space, precision);
          ASSERT_TRUE(back);
          // Of several targets with the same ray and aim, the first is found.
          FuzzInput expected = input;
          if (back->target != input.target) {
            ASSERT_LT(back->target, input.target);
            ASSERT_EQ(to_case(*back).aim, made.aim);
            expected.target = back->target;
          }
          ASSERT_EQ(encoded(*back), encoded(expected));
        }
}

TEST(CaseBytes, OutsideOfTheDomain) {
  const auto in = [](const auto& change, Domain domain, Precision precision = Precision::binary64) {
    FuzzInput input = ray_input(precision);
    change(input);
    return in_domain(input, domain);
  };
  const auto in_both = [&](const auto& change) { return in(change, Domain::nominal) && in(change, Domain::full); };
  const auto in_neither = [&](const auto& change) {
    return !in(change, Domain::nominal) && !in(change, Domain::full);
  };
  EXPECT_TRUE(in_both([](FuzzInput&) {}));
  EXPECT_TRUE(in_both([](FuzzInput& x) { x.ray.direction = {-0.0, 0, 0}; }));
  EXPECT_TRUE(in_both([](FuzzInput& x) { x.triangle.c = x.triangle.b; }));
  EXPECT_TRUE(in_both([](FuzzInput& x) { x.ray.t_min = -inf, x.ray.t_max = inf; }));
  EXPECT_TRUE(in_neither([](FuzzInput& x) { x.triangle.b.y = inf; }));
  EXPECT_TRUE(in_neither([](FuzzInput& x) { x.triangle.b.y = nan; }));
  EXPECT_TRUE(in_neither([](FuzzInput& x) { x.ray.t_min = nan; }));
  EXPECT_TRUE(in_neither([](FuzzInput& x) { x.standoff = 1; })) << "of the ray space";
  EXPECT_TRUE(in_neither([](FuzzInput& x) { x.target = 1; })) << "of the ray space";
  for (const double x : {0x1p20, -0x1p20, 0x1.fffffffffffffp-41, 0x1p-1074}) {
    const auto change = [x](FuzzInput& input) { input.triangle.a.z = x; };
    EXPECT_FALSE(in(change, Domain::nominal)) << x;
    EXPECT_TRUE(in(change, Domain::full)) << x;
  }
  EXPECT_FALSE(in([](FuzzInput& x) { x.ray.t_min = inf; }, Domain::nominal));
  EXPECT_TRUE(in([](FuzzInput& x) { x.ray.t_min = inf; }, Domain::full));
  const auto tenth = [](FuzzInput& x) { x.ray.origin.x = 0.1; };
  EXPECT_TRUE(in(tenth, Domain::full));
  EXPECT_FALSE(in(tenth, Domain::full, Precision::binary32));

  const auto target = [](unsigned index, const auto& change) {
    FuzzInput input = target_input(index);
    change(input);
    return in_domain(input, Domain::full);
  };
  EXPECT_TRUE(target(10, [](FuzzInput&) {}));
  EXPECT_FALSE(target(10, [](FuzzInput& x) { x.target = 28; }));
  EXPECT_FALSE(target(10, [](FuzzInput& x) { x.tolerance = 0; }));
  EXPECT_FALSE(target(10, [](FuzzInput& x) { x.standoff = -1; }));
  EXPECT_FALSE(target(10, [](FuzzInput& x) { x.ray.origin.x = 1; })) << "it follows from the rest";
  EXPECT_FALSE(target(9, [](FuzzInput& x) { x.tolerance = 1; }));
  EXPECT_FALSE(target(9, [](FuzzInput& x) { x.tolerance = -0.0; }));
}

TEST(CaseBytes, NoInputIsThisCase) {
  const auto of_ray = [](const auto& change, Precision precision = Precision::binary64) {
    Case made = to_case(ray_input());
    change(made);
    return from_case(made, Space::ray, precision).has_value();
  };
  EXPECT_TRUE(of_ray([](Case&) {}));
  EXPECT_TRUE(of_ray([](Case&) {}, Precision::binary32)) << "numbers count, not the name of their precision";
  EXPECT_TRUE(of_ray([](Case& x) { x.ray.direction = {}; }));
  EXPECT_FALSE(of_ray([](Case& x) { x.ray.origin.x = 0.1; }, Precision::binary32));
  EXPECT_FALSE(of_ray([](Case& x) { x.ray.origin.x = inf; }));
  EXPECT_FALSE(of_ray([](Case& x) { x.ray.t_max = nan; }));
  EXPECT_FALSE(of_ray([](Case& x) { x.bag.triangles.clear(); }));
  EXPECT_FALSE(of_ray([](Case& x) { x.bag.triangles.push_back({}); }));
  EXPECT_FALSE(of_ray([](Case& x) { x.bag.mode = BagMode::solid; }));
  EXPECT_FALSE(of_ray([](Case& x) { x.bag.orientation = Orientation::ccw; }));

  const auto of_target = [](const auto& change, Precision precision = Precision::binary64) {
    Case made = to_case(target_input(17));
    change(made);
    return from_case(made, Space::target, precision).has_value();
  };
  EXPECT_TRUE(of_target([](Case&) {}));
  EXPECT_FALSE(of_target([](Case&) {}, Precision::binary32)) << "another ray, rounded";
  EXPECT_FALSE(of_target([](Case& x) { x.aim.reset(); }));
  EXPECT_FALSE(of_target([](Case& x) { x.aim->wish = Wish::none; }));
  EXPECT_FALSE(of_target([](Case& x) { x.aim->standoff = 12; }));
  EXPECT_FALSE(of_target([](Case& x) { x.ray.t_max = 12; }));
  EXPECT_FALSE(of_target([](Case& x) { x.ray.origin.x = step_ulps(x.ray.origin.x, 1); }));
}

}  // namespace
}  // namespace plumbline
