#include "case/dials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <string>

#include "case/float_bits.h"

namespace plumbline {
namespace {

std::array<double, 17> numbers(const Shot& shot) { return std::bit_cast<std::array<double, 17>>(shot); }

// Of the bits of the first 200 shots of each setting.
std::uint64_t checksum(Dial dial, Precision precision) {
  std::uint64_t sum = 1469598103934665603u;
  for (const int setting : settings(dial, precision))
    for (std::uint64_t i = 0; i < 200; ++i)
      for (const double x : numbers(draw(dial, setting, precision, 1, i))) {
        sum = (sum ^ std::bit_cast<std::uint64_t>(x)) * 1099511628211u;
        sum ^= sum >> 29;
      }
  return sum;
}

class EveryDial : public testing::TestWithParam<std::tuple<std::string_view, std::string_view>> {
 protected:
  Dial dial = static_cast<Dial>(std::ranges::find(dial_names, std::get<0>(GetParam())) - dial_names.begin());
  Precision precision = std::get<1>(GetParam()) == "binary32" ? Precision::binary32 : Precision::binary64;
};

TEST_P(EveryDial, HoldsNumbersOfThePrecision) {
  for (const int setting : settings(dial, precision))
    for (std::uint64_t i = 0; i < 200; ++i) {
      const auto all = numbers(draw(dial, setting, precision, 1, i));
      for (std::size_t k = 0; k < 16; ++k) {
        ASSERT_TRUE(is_finite(all[k])) << setting << " " << i;
        ASSERT_TRUE(precision == Precision::binary64 || is_binary32(all[k])) << setting << " " << i;
      }
      EXPECT_EQ(all[15], 0.0);
      EXPECT_TRUE(std::isinf(all[16]));
    }
}

TEST_P(EveryDial, TurnsEvenlyFromEasyToHard) {
  const auto at = settings(dial, precision);
  ASSERT_GE(at.size(), 8u);
  EXPECT_LE(at.front(), 4);
  for (std::size_t i = 1; i < at.size(); ++i) EXPECT_EQ(at[i] - at[i - 1], at[1] - at[0]);
  EXPECT_FALSE(meaning(dial).empty());
}

TEST_P(EveryDial, DependsOnSettingSeedAndIndex) {
  const auto at = settings(dial, precision);
  const Shot shot = draw(dial, at[1], precision, 1, 5);
  EXPECT_EQ(numbers(shot), numbers(draw(dial, at[1], precision, 1, 5)));
  EXPECT_NE(numbers(shot), numbers(draw(dial, at[2], precision, 1, 5)));
  EXPECT_NE(numbers(shot), numbers(draw(dial, at[1], precision, 2, 5)));
  EXPECT_NE(numbers(shot), numbers(draw(dial, at[1], precision, 1, 6)));
}

INSTANTIATE_TEST_SUITE_P(Dials, EveryDial,
                         testing::Combine(testing::ValuesIn(dial_names), testing::ValuesIn(precision_names)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param)) + "_" + std::string(std::get<1>(info.param));
                         });

// The order of a call's arguments is the compiler's choice: the sums hold with clang and g++.
TEST(Dials, AreTheSameBitsWithEveryCompiler) {
  const std::map<std::string_view, std::array<std::uint64_t, 2>> expected = {
      {"needle", {0xfdd046aa52daf77bu, 0x6ce4aa1b8566ef80u}},
      {"cap", {0xff363a719ea123c3u, 0x4283d0712ae4865fu}},
      {"grazing", {0x1839798d27e3edb9u, 0xb5f217aa564226a3u}},
      {"parallel", {0xa0b837dba82cd922u, 0xf6ec0ce53be1e96bu}},
      {"far", {0x5f18aef7f48e9abeu, 0xc121af25d4eef331u}},
      {"tiny", {0xec733476e243f69du, 0xfcc0de1743b6896bu}},
      {"huge", {0x115622f4bf81f5b1u, 0xba6dcabc2b79fda7u}},
      {"near_start", {0xab06a1d53024409cu, 0x276222a0ff83a9b6u}},
      {"near_edge", {0x803bcb0e6ac5511u, 0xb3388ec7ee24b164u}},
      {"near_vertex", {0x54e5224684c59b6au, 0x66fa5400acfc0e4au}},
      {"lattice", {0x2b49c6fe5e32e838u, 0x602c38cb181e39e1u}},
      {"direction_scale", {0xd984da9647cad2ebu, 0x53feff5cdb23fff2u}},
      {"mixed_exponents", {0x5c227054cbfb08du, 0xbfaafb22eff68ae1u}},
  };
  for (std::size_t i = 0; i < dial_names.size(); ++i) {
    const auto dial = static_cast<Dial>(i);
    const std::array sums = {checksum(dial, Precision::binary32), checksum(dial, Precision::binary64)};
    EXPECT_EQ(sums, expected.at(dial_names[i])) << dial_names[i] << std::hex << " 0x" << sums[0] << " 0x" << sums[1];
  }
}

}  // namespace
}  // namespace plumbline
