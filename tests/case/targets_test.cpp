#include "case/targets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "case/float_bits.h"
#include "case/input_error.h"
#include "case/lattice.h"
#include "tests/recorded_rows.h"

namespace plumbline {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<Ray> rays_at(const Triangle& triangle, const Aiming& aiming) {
  std::vector<Ray> rays(aims(aiming).size());
  aim_rays(triangle, aiming, rays);
  return rays;
}

constexpr Triangle slanted = {{0, 0, 0}, {0, 0, 1.5}, {0, 1.5, 0}};

TEST(Targets, AreAsManyAsTheReportHas) {
  int interior = 0, vertex_edge = 0, wished_hit = 0, wished_miss = 0;
  for (const Aim& aim : aims({})) {
    interior += aim.target == TargetKind::interior;
    vertex_edge += aim.target == TargetKind::vertex_edge;
    if (aim.tolerance == 0.001) (aim.wish == Wish::hit ? wished_hit : wished_miss) += 1;
    EXPECT_EQ(aim.standoff, 5);
  }
  EXPECT_EQ(interior, 4);
  EXPECT_EQ(vertex_edge, 6);
  EXPECT_EQ(wished_hit, 9);
  EXPECT_EQ(wished_miss, 9);
  EXPECT_EQ(aims({}).size(), 64);
}

TEST(Targets, FollowTheReportsEquations) {
  const auto rays = rays_at(slanted, {});
  const Vec3 down = {-1, 0, 0};
  const auto origin_of = [&](std::size_t i) {
    EXPECT_EQ(rays[i].direction, down);
    return rays[i].origin;
  };
  EXPECT_EQ(origin_of(0), (Vec3{5, 0.5, 0.5}));                                      // centroid
  EXPECT_EQ(origin_of(8), (Vec3{5, 0.75, 0.75}));                                    // middle of BC
  EXPECT_EQ(origin_of(10), (Vec3{5, 0, 0x1.999999999999bp-4}));                      // 0.1 from A towards B
  EXPECT_EQ(origin_of(19), (Vec3{5, -0x1.21a1851ff630bp-4, 0x1.921a1851ff631p+0}));  // 0.1 beyond B on CB
  EXPECT_EQ(origin_of(22), (Vec3{5, 0x1.5bcbcf5c0139fp-1, 0x1.5bcbcf5c0139fp-1}));   // 0.1 from BC's middle towards A
  EXPECT_EQ(origin_of(43), (Vec3{5, 0x1.805cae90fffcdp-1, 0x1.805cae90fffcdp-1}));   // 0.001 the other way
}

std::array<std::uint64_t, 6> bits(const Ray& r) {
  return {to_bits(r.origin.x),    to_bits(r.origin.y),    to_bits(r.origin.z),
          to_bits(r.direction.x), to_bits(r.direction.y), to_bits(r.direction.z)};
}

// The ids of the recorded rows count the rays of the report's experiment.
void expect_recorded_rays(const std::filesystem::path& directory) {
  const LatticeAxis axis = {{2, 0}, {15, -1}, {}};
  const Lattice lattice = make_lattice({axis, axis, axis});
  std::vector<Triangle> triangles;
  for (std::uint64_t i = 0; i < triple_count(lattice); ++i)
    if (const LatticeTriple triple = triple_at(lattice, i); !collinear(triple))
      triangles.push_back(triangle_of(lattice, triple));
  const auto rows = read_recorded_rows(directory / "brlcad-7.24.2-lattice.csv");
  ASSERT_FALSE(rows.empty());
  for (const RecordedRow& row : rows) {
    const std::size_t id = std::stoul(row.id);
    ASSERT_EQ(triangles.at(id / 64), row.triangle) << row.id;
    ASSERT_EQ(bits(rays_at(row.triangle, {})[id % 64]), bits(row.ray)) << row.id;
  }
}

TEST(Targets, AreTheRecordedOnesBitForBit) { expect_recorded_rays(recorded_sample()); }

TEST(Targets, AreAllOfTheRecordedOnesBitForBit) {
  if (!full_recordings()) GTEST_SKIP() << "PLUMBLINE_RECORDED names no directory with the full recordings";
  expect_recorded_rays(*full_recordings());
}

TEST(Targets, NormalCanBeDividedMultipliedOrLeft) {
  const Triangle t = {{0, 0, 0}, {1.5, 0, 0}, {0, 1.5, 1.5}};  // AB x AC = 2.25 (0, -1, 1)
  EXPECT_EQ(rays_at(t, {.normal = Normal::divide})[0].direction.z, 0x1.6a09e667f3bcdp-1);
  EXPECT_EQ(rays_at(t, {.normal = Normal::reciprocal})[0].direction.z, 0x1.6a09e667f3bccp-1);
  EXPECT_EQ(rays_at(t, {.normal = Normal::none})[0].direction, (Vec3{0, -2.25, 2.25}));
}

TEST(Targets, AreMetExactlyByRaysThatAreNotNormalised) {
  const LatticeAxis axis = {{2, 0}, {15, -1}, {25, -2}};
  const Lattice lattice = make_lattice({axis, axis, axis});
  for (std::uint64_t i = 0; i < triple_count(lattice); ++i) {
    const LatticeTriple triple = triple_at(lattice, i);
    if (collinear(triple)) continue;
    const Triangle t = triangle_of(lattice, triple);
    const auto rays = rays_at(t, {.standoff = 0.375, .normal = Normal::none});
    // Three multiples of 2^-9 below 2^10: no rounding in here either.
    const auto met = [&](const Ray& r) {
      return Vec3{r.origin.x + 0.375 * r.direction.x, r.origin.y + 0.375 * r.direction.y,
                  r.origin.z + 0.375 * r.direction.z};
    };
    ASSERT_EQ(met(rays[4]), t.a);
    ASSERT_EQ(met(rays[5]), t.b);
    ASSERT_EQ(met(rays[6]), t.c);
    ASSERT_EQ(met(rays[8]), (Vec3{(t.b.x + t.c.x) / 2, (t.b.y + t.c.y) / 2, (t.b.z + t.c.z) / 2}));
  }
}

TEST(Targets, RefuseBadDistances) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_NO_THROW(check({}));
  for (const double bad : {0.0, -1.0, nan, inf}) {
    EXPECT_THAT([&] { check({.standoff = bad}); }, ThrowsMessage<InputError>(HasSubstr("standoff")));
    EXPECT_THAT([&] { check({.tolerances = {0.1, bad}}); }, ThrowsMessage<InputError>(HasSubstr("tolerance")));
  }
}

}  // namespace
}  // namespace plumbline
