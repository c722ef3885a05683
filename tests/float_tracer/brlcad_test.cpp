// The adapter to a real BRL-CAD: what it passes on, what it refuses, and that it answers as recorded.
#include <gtest/gtest.h>

#include <thread>

#include "case/float_bits.h"
#include "float_tracer/adapters/brlcad.h"
#include "tests/float_tracer/brlcad_agreement.h"
#include "tests/float_tracer/shoot.h"
#include "tests/judges/seed.h"
#include "tests/recorded_rows.h"

namespace plumbline {
namespace {

constexpr const char* librt = "brlcad_librt";
const Triangle flat{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
const Ray down{.origin = {0.5, 0.5, 5}, .direction = {0, 0, -2}};

Bag surface(const Triangle& triangle) { return {.triangles = {triangle}}; }

Triangle moved(Triangle t, double z) {
  t.a.z += z, t.b.z += z, t.c.z += z;
  return t;
}

// Returns how many rows there were. Recorded from 7.24.2, but the rules are those of all versions from 7.22 to 7.40.
std::size_t compare_recorded(const std::filesystem::path& directory) {
  std::size_t count = 0;
  for (const auto& file : recorded_files(directory))
    for (const RecordedRow& row : read_recorded_rows(file)) {
      ++count;
      const Answer answer = shoot(librt, recorded_bag(row.triangle), row.ray);
      EXPECT_EQ(answer.outcome, row.hit ? Outcome::hit : Outcome::miss) << file.filename() << " row " << row.id;
      EXPECT_EQ(to_bits(answer.in), to_bits(row.in)) << file.filename() << " row " << row.id;
      EXPECT_EQ(to_bits(answer.out), to_bits(row.out)) << file.filename() << " row " << row.id;
    }
  return count;
}

TEST(BrlcadLibrt, AnswersAsRecorded) { EXPECT_EQ(compare_recorded(recorded_sample()), 1913u); }

TEST(BrlcadLibrt, AnswersAsRecordedInFull) {
  const auto directory = full_recordings();
  if (!directory) GTEST_SKIP() << "set PLUMBLINE_RECORDED to a directory of full recordings";
  std::printf("%zu recorded rows compared\n", compare_recorded(*directory));
}

TEST(BrlcadLibrt, EqualsClassic) {
  BrlcadAgreement agreement;
  agreement.compare_families(judges::seed(), 200);
  agreement.compare_lattice(0, 5);
  agreement.compare_aimed(judges::seed(), 500);
  EXPECT_GT(agreement.hits(), 5000u);
  EXPECT_LT(agreement.beyond(), 20u);
  EXPECT_EQ(agreement.differences(), 0u) << "PLUMBLINE_SEED=" << judges::seed();
}

TEST(BrlcadLibrt, EqualsClassicOnMeshes) {
  BrlcadAgreement agreement;
  agreement.compare_meshes(judges::seed(), 1000);
  EXPECT_GT(agreement.partitions(), 10000u);
  EXPECT_LT(agreement.beyond(), 2000u);
  EXPECT_EQ(agreement.differences(), 0u) << "PLUMBLINE_SEED=" << judges::seed();
}

TEST(BrlcadLibrt, NamesTheFaceThatIsHitFirst) {
  const Bag bag{.triangles = {moved(flat, -4), moved(flat, -2), flat}};
  const Answer answer = shoot(librt, bag, down);
  ASSERT_EQ(answer.outcome, Outcome::hit);
  EXPECT_TRUE(answer.has_t && answer.has_segment && !answer.has_uv);
  EXPECT_EQ(answer.triangle, 2u);
  EXPECT_EQ(answer.t, 2.5);
}

TEST(BrlcadLibrt, ReportsWhereAnOrientedSolidIsEnteredAndLeft) {
  const Vec3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0}, d{0, 0, 4};
  Bag bag{.triangles = {{a, c, b}, {a, b, d}, {a, d, c}, {b, c, d}},
          .mode = BagMode::solid,
          .orientation = Orientation::ccw};
  const Answer answer = shoot(librt, bag, {.origin = {1, 1, 6}, .direction = {0, 0, -1}});
  ASSERT_EQ(answer.outcome, Outcome::hit);
  EXPECT_EQ(answer.in, 4);
  EXPECT_EQ(answer.out, 6);
  EXPECT_EQ(answer.triangle, 3u);
}

// Beyond 32 faces BRL-CAD cuts a bag into pieces, and keeps state for them from ray to ray.
TEST(BrlcadLibrt, ShootsAtManyFacesAndAtTwoBagsInTurn) {
  Bag stack;
  for (int i = 0; i < 40; ++i) stack.triangles.push_back(moved(flat, -i));
  const auto both = {tracer_named(librt).prepare(stack), tracer_named(librt).prepare(surface(moved(flat, 1)))};
  for (int i = 0; i < 3; ++i) {
    double expected = 2.5;
    for (const auto& bag : both) {
      Answer answer;
      bag->trace({&down, 1}, {&answer, 1});
      EXPECT_EQ(answer.outcome, Outcome::hit);
      EXPECT_EQ(answer.t, expected);
      expected = 2;
    }
  }
}

TEST(BrlcadLibrt, TakesBagsFromSeveralThreads) {
  std::vector<std::thread> threads;
  std::array<int, 4> hits{};
  for (int& mine : hits)
    threads.emplace_back([&mine] {
      for (int i = 0; i < 50; ++i) mine += shoot(librt, surface(moved(flat, -i)), down).outcome == Outcome::hit;
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(hits, (std::array{50, 50, 50, 50}));
}

TEST(BrlcadLibrt, PutsTheDirectionAsItIs) {
  EXPECT_EQ(shoot(librt, surface(flat), down).t, 2.5);
  EXPECT_EQ(shoot(librt, surface(flat), {.origin = {0.5, 0.5, 5}, .direction = {0, 0, -0.5}}).t, 10);
}

TEST(BrlcadLibrt, MissesWhereNoFaceIsLeft) {
  EXPECT_EQ(shoot(librt, {}, down).outcome, Outcome::miss);
  const double leg = 0x1p-6;  // |ab x ac| below 0.0005
  EXPECT_EQ(shoot(librt, surface({{0, 0, 0}, {leg, 0, 0}, {0, leg, 0}}),
                  {.origin = {leg / 4, leg / 4, 5}, .direction = {0, 0, -1}})
                .outcome,
            Outcome::miss);
}

TEST(BrlcadLibrt, FaultsOnWhatIsNotFinite) {
  for (const double bad : {not_a_number, infinity, -infinity}) {
    for (std::size_t i = 0; i < 9; ++i) {
      Triangle spoilt = flat;
      *coordinates(spoilt)[i] = bad;
      EXPECT_EQ(shoot(librt, surface(spoilt), down).outcome, Outcome::fault) << i;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      Ray spoilt = down;
      *coordinates(spoilt)[i] = bad;
      EXPECT_EQ(shoot(librt, surface(flat), spoilt).outcome, Outcome::fault) << i;
    }
    EXPECT_EQ(shoot(librt, {.triangles = {flat}, .mode = BagMode::plate, .thickness = bad}, down).outcome,
              Outcome::fault);
  }
}

}  // namespace
}  // namespace plumbline
