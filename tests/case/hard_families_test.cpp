#include "case/hard_families.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <string>

namespace plumbline {
namespace {

// Of the bits of the first 2000 shots.
std::uint64_t checksum(Family family) {
  std::uint64_t sum = 1469598103934665603u;
  for (std::uint64_t i = 0; i < 2000; ++i)
    for (const std::uint64_t word : std::bit_cast<std::array<std::uint64_t, 17>>(draw(family, 1, i))) {
      sum = (sum ^ word) * 1099511628211u;
      sum ^= sum >> 29;
    }
  return sum;
}

// The order of a call's arguments is the compiler's choice: clang and g++ once drew other cases from the same seed.
TEST(HardFamilies, AreTheSameBitsWithEveryCompiler) {
  const std::array<std::pair<std::string_view, std::uint64_t>, family_names.size()> expected = {{
      {"random", 0x60c2aeb38277a24e},
      {"small_far", 0x33efa109dc722242},
      {"lattice_points", 0xdbfaea6a08b1fcde},
      {"exact_edge12", 0x88e4587a6071b13c},
      {"exact_edge23", 0xd8e9e15c58e29a10},
      {"exact_edge51", 0x7a8c06b91394c7ea},
      {"ulp12", 0x800987486337e767},
      {"ulp51", 0xea62f1f6204e6110},
      {"coplanar", 0x52c967be799614cf},
      {"degenerate", 0x725be1494fb97b7f},
      {"mixed40", 0x2f7369bf1a47d73c},
      {"wide", 0x0ae0f62275c1d9ac},
      {"wide_edge", 0x1807c24593400a58},
      {"full_range", 0x40f58906fed42047},
      {"sliver", 0xb7bdb757bc3eac27},
      {"far", 0x63321cc300b96199},
      {"grazing", 0xde450926e51ee778},
      {"tiny", 0x23d27ae8413f8a62},
      {"huge", 0x8fcc44575d0988c2},
      {"edge_ulps", 0x2c3972268b8a81a4},
  }};
  for (std::size_t i = 0; i < family_names.size(); ++i) {
    EXPECT_EQ(family_names[i], expected[i].first);
    EXPECT_EQ(checksum(static_cast<Family>(i)), expected[i].second) << family_names[i];
  }
}

}  // namespace
}  // namespace plumbline
