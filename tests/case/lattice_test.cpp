#include "case/lattice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case/input_error.h"

namespace plumbline {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

LatticeAxis axis(std::string_view box, std::string_view step, std::string_view offset = "0") {
  return {parse_decimal(box, "box"), parse_decimal(step, "step"), parse_decimal(offset, "offset")};
}

Lattice cube(std::string_view box, std::string_view step, std::string_view offset = "0") {
  const LatticeAxis a = axis(box, step, offset);
  return make_lattice({a, a, a});
}

std::uint64_t count_triangles(const Lattice& lattice) {
  std::uint64_t triangles = 0;
  for (std::uint64_t i = 0; i < triple_count(lattice); ++i) triangles += !collinear(triple_at(lattice, i));
  return triangles;
}

TEST(Lattice, OfTheReportHas336Triangles) {
  const Lattice lattice = cube("2", "1.5");
  EXPECT_THAT(lattice.layers[0], ElementsAre(0, 1.5));
  EXPECT_EQ(point_count(lattice), 8);
  EXPECT_EQ(triple_count(lattice), 512);
  EXPECT_EQ(count_triangles(lattice), 336);
}

TEST(Lattice, SkipsTriplesOnALine) {
  // 27 points: 27 * 26 * 25 ordered triples of distinct points, of which 49 lines of three, six orders each.
  EXPECT_EQ(count_triangles(cube("1", "0.5")), 27 * 26 * 25 - 49 * 6);
}

TEST(Lattice, DoesNotLoseTheLastLayer) {
  const Lattice lattice = cube("2", "0.05");
  ASSERT_EQ(lattice.layers[0].size(), 41);
  EXPECT_EQ(lattice.layers[0][40], 2.0);
  EXPECT_EQ(lattice.layers[0][3], 0x1.3333333333333p-3);  // 0.15; three times the double 0.05 is one ulp more
}

TEST(Lattice, RoundsOffsetAndStepTogether) {
  const Lattice lattice = cube("2", "0.1", "0.2");
  EXPECT_EQ(lattice.layers[0][1], 0x1.3333333333333p-2);  // 0.3; 0.1 + 0.2 in doubles is one ulp more
}

TEST(Lattice, HasItsOwnBoxStepAndOffsetAlongEachAxis) {
  const Lattice lattice = make_lattice({axis("2", "1.5"), axis("1", "0.25", "-1"), axis("1e30", "5e29")});
  EXPECT_THAT(lattice.layers[0], ElementsAre(0, 1.5));
  EXPECT_THAT(lattice.layers[1], ElementsAre(-1, -0.75, -0.5, -0.25, 0));
  EXPECT_THAT(lattice.layers[2], ElementsAre(0, 5e29, 1e30));
}

TEST(Lattice, CountsInTheOrderOfNineNestedLoops) {
  const Lattice lattice = make_lattice({axis("1", "1"), axis("2", "1"), axis("3", "1")});
  std::uint64_t index = 0;
  std::vector<LatticePoint> points;
  for (std::uint32_t x = 0; x < 2; ++x)
    for (std::uint32_t y = 0; y < 3; ++y)
      for (std::uint32_t z = 0; z < 4; ++z) points.push_back({x, y, z});
  for (const LatticePoint& a : points)
    for (const LatticePoint& b : points)
      for (const LatticePoint& c : points) ASSERT_EQ(triple_at(lattice, index++), (LatticeTriple{a, b, c}));
  EXPECT_EQ(index, triple_count(lattice));
}

TEST(Lattice, OfATrillionTriplesIsAddressedAnywhere) {
  const Lattice lattice = make_lattice({axis("99", "1"), axis("9", "1"), axis("9", "1")});
  ASSERT_EQ(triple_count(lattice), 1'000'000'000'000);
  EXPECT_EQ(triple_at(lattice, 999'999'999'999), (LatticeTriple{{{99, 9, 9}, {99, 9, 9}, {99, 9, 9}}}));
  EXPECT_EQ(triple_at(lattice, 123'456'789'012), (LatticeTriple{{{12, 3, 4}, {56, 7, 8}, {90, 1, 2}}}));
}

TEST(Lattice, DecidesCollinearityOnIndices) {
  EXPECT_TRUE(collinear({{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}}));
  EXPECT_TRUE(collinear({{{5, 5, 5}, {5, 5, 5}, {9, 1, 0}}}));
  EXPECT_TRUE(collinear({{{4, 4, 4}, {0, 2, 3}, {4, 4, 4}}}));
  EXPECT_FALSE(collinear({{{0, 0, 0}, {1, 2, 3}, {2, 4, 7}}}));
  EXPECT_FALSE(collinear({{{0, 0, 0}, {2642244, 2642243, 1}, {2642243, 2642242, 1}}}));
  // 0.1 0.2 0.3 lie on a line although the doubles nearest to them don't.
  const Lattice tenths = cube("0.3", "0.1");
  const LatticeTriple diagonal = {{{1, 0, 0}, {2, 1, 0}, {3, 2, 0}}};
  EXPECT_TRUE(collinear(diagonal));
  EXPECT_EQ(triangle_of(tenths, diagonal).c, (Vec3{0x1.3333333333333p-2, 0x1.999999999999ap-3, 0}));
}

TEST(Lattice, ChecksARangeOfTriples) {
  const Lattice lattice = cube("2", "1.5", "0.25");
  EXPECT_EQ(offset_of(lattice), (Vec3{0.25, 0.25, 0.25}));
  EXPECT_EQ(triple_range(lattice, 100, {}).end, 512);
  EXPECT_EQ(triple_range(lattice, 100, 412).end, 512);
  EXPECT_THAT([&] { triple_range(lattice, 512, {}); }, ThrowsMessage<InputError>(HasSubstr("triples [0, 512)")));
  EXPECT_THAT([&] { triple_range(lattice, 100, 413); },
              ThrowsMessage<InputError>(HasSubstr("only 412 ordered triples")));
}

TEST(Lattice, RefusesBadInputNamingTheFix) {
  const auto refused = [](std::string_view box, std::string_view step, std::string_view offset, const char* message) {
    EXPECT_THAT(
        [&] {
          make_lattice({axis("2", "1"), axis(box, step, offset), axis("2", "1")});
        },
        ThrowsMessage<InputError>(HasSubstr(message)));
  };
  refused("2", "0", "0", "step along y: 0 is not positive; give a step");
  refused("2", "-1", "0", "step along y: -1 is not positive; give a step");
  refused("0", "1", "0", "box along y: 0 is not positive; give a box");
  refused("2", "2.5", "0", "step along y: 2.5 is larger than the box, 2");
  refused("2", "1e-9", "0", "2000000001 layers are too many");
  refused("2", "1e-30", "0", "box along y: 2e0 is more than 18 digits away");
  refused("2", "0.1", "1e16", "step along y: 0.1 is lost beside the offset");
  EXPECT_THAT([] { cube("2", "0.01"); }, ThrowsMessage<InputError>(HasSubstr("more than 2642245 lattice points")));
}

}  // namespace
}  // namespace plumbline
