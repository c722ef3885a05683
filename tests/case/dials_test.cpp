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
  };
  for (std::size_t i = 0; i < dial_names.size(); ++i) {
    const auto dial = static_cast<Dial>(i);
    const std::array sums = {checksum(dial, Precision::binary32), checksum(dial, Precision::binary64)};
    const auto at = expected.find(dial_names[i]);
    ASSERT_NE(at, expected.end()) << dial_names[i] << std::hex << " 0x" << sums[0] << " 0x" << sums[1];
    EXPECT_EQ(sums, at->second) << dial_names[i] << std::hex << " 0x" << sums[0] << " 0x" << sums[1];
  }
}

}  // namespace
}  // namespace plumbline
