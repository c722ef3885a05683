// The archive: the laws of merging, with features that are made up and with real ones; scores, ties and parents by
// hand.
#include "fuzz/elites.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/fuzz/searched.h"

namespace plumbline {
namespace {

// ---- by hand

FuzzInput input_of(double x) {
  FuzzInput input;
  input.ray.origin.x = x;
  return input;
}

Features in_cells(std::initializer_list<Cell> cells, double error, double severity = 0, bool nominal = false) {
  Features f{.error = error, .severity = severity, .found = severity, .nominal = nominal, .cells = {}};
  for (const Cell cell : cells) f.cells[f.size++] = cell;
  return f;
}

constexpr Cell found = signature_cell | 5;

TEST(Elites, ScoreIsTheErrorOrOfFindingsTheSeverity) {
  const Features f = in_cells({}, 0x1p+3, 0x1p+1);
  EXPECT_EQ(score_in(0, f), 0x1p+3);
  EXPECT_EQ(score_in(worst_nominal_cell - 1, f), 0x1p+3);
  EXPECT_EQ(score_in(worst_nominal_cell + 1, f), 0x1p+3);
  EXPECT_EQ(score_in(plain_cells - 1, f), 0x1p+3);
  EXPECT_EQ(score_in(worst_nominal_cell, f), 0x1p+1);
  EXPECT_EQ(score_in(signature_cell, f), 0x1p+1);
  EXPECT_EQ(score_in(found, f), 0x1p+1);
}

TEST(Elites, HoldTheWorstOfEachCell) {
  Elites elites;
  EXPECT_EQ(elites.at(7), nullptr);
  EXPECT_EQ(elites.at(found), nullptr);
  EXPECT_EQ(elites.offer(input_of(0x1p+0), in_cells({7, 8, found}, 0x1p+0, 0x1p+4)), 3u);
  EXPECT_EQ(elites.offer(input_of(0x1p+1), in_cells({7, found}, 0x1p+1, 0x1p+3)), 1u);
  ASSERT_EQ(elites.changed().size(), 1u);
  EXPECT_EQ(elites.all()[elites.changed()[0]].cell, 7u);
  EXPECT_EQ(elites.all().size(), 3u);
  EXPECT_EQ(elites.at(7)->input, input_of(0x1p+1));
  EXPECT_EQ(elites.at(7)->score, 0x1p+1);
  EXPECT_EQ(elites.at(8)->input, input_of(0x1p+0));
  EXPECT_EQ(elites.at(found)->input, input_of(0x1p+0));
  EXPECT_EQ(elites.at(found)->score, 0x1p+4);
  EXPECT_EQ(elites.offer(input_of(0x1p+2), in_cells({7}, 0x1.8p+0)), 0u);
  EXPECT_TRUE(elites.changed().empty());
  EXPECT_EQ(elites.offer(input_of(0x1p+2), in_cells({}, 0x1p+9)), 0u);
  EXPECT_EQ(elites.all().size(), 3u);
}

TEST(Elites, DriveIsTheErrorOfNominalCases) {
  Elites elites;
  elites.offer(input_of(0x1p+0), in_cells({7}, 0x1p+3, 0, true));
  elites.offer(input_of(0x1p+1), in_cells({8}, 0x1p+4, 0, false));
  EXPECT_EQ(elites.at(7)->drive, 0x1p+3);
  EXPECT_EQ(elites.at(8)->drive, 0x0p+0);
}

// Little-endian, 2 is 00 ... 00 40 and 1 is 00 ... f0 3f: the bytes of 2 are less.
TEST(Elites, TiesGoToTheLesserBytes) {
  for (const auto& [first, second] : {std::pair{0x1p+0, 0x1p+1}, {0x1p+1, 0x1p+0}}) {
    Elites elites;
    elites.offer(input_of(first), in_cells({7, found}, 0x1p+0, 0x1p+0));
    EXPECT_EQ(elites.offer(input_of(second), in_cells({7, found}, 0x1p+0, 0x1p+0)), second == 0x1p+1 ? 2u : 0u);
    EXPECT_EQ(elites.at(7)->input, input_of(0x1p+1));
    EXPECT_EQ(elites.at(found)->input, input_of(0x1p+1));
    EXPECT_EQ(elites.offer(input_of(0x1p+1), in_cells({7, found}, 0x1p+0, 0x1p+0)), 0u);
  }
}

TEST(Elites, FingerprintIsOfCellsAndInputs) {
  const auto print = [](std::initializer_list<std::pair<Cell, double>> list) {
    Elites elites;
    for (const auto& [cell, x] : list) elites.offer(input_of(x), in_cells({cell}, 0x1p+0));
    return fingerprint(elites);
  };
  EXPECT_EQ(print({{7, 0x1p+0}, {8, 0x1p+1}}), print({{8, 0x1p+1}, {7, 0x1p+0}}));
  const std::set<std::uint64_t> different = {print({}),
                                             print({{7, 0x1p+0}}),
                                             print({{8, 0x1p+0}}),
                                             print({{7, 0x1.0000000000001p+0}}),
                                             print({{7, -0x1p+0}}),
                                             print({{7, 0x1p+0}, {8, 0x1p+1}}),
                                             print({{8, 0x1p+0}, {7, 0x1p+1}})};
  EXPECT_EQ(different.size(), 7u);
}

// ---- parents

TEST(Elites, NoParentWhereThereIsNone) {
  Random random(1, 0);
  EXPECT_EQ(Elites().parent(random), nullptr);
}

// Of two elites, with probability 3/4 any, else the best of eight picks: 3/4 1/2 + 1/4 (1 - 2^-8) = 0.624.
TEST(Elites, MostParentsAreAnyAndSomeTheGreatestDrive) {
  Elites elites;
  elites.offer(input_of(0x1p+0), in_cells({7}, 0x1p+3, 0, true));
  elites.offer(input_of(0x1p+1), in_cells({8}, 0x1p+9, 0, false));
  Random random(20260101, 0), same(20260101, 0);
  constexpr int draws = 100000;
  int driven = 0;
  for (int i = 0; i < draws; ++i) {
    const Elite* parent = elites.parent(random);
    ASSERT_TRUE(parent == elites.at(7) || parent == elites.at(8));
    ASSERT_EQ(parent, elites.parent(same));
    driven += parent == elites.at(7);
  }
  EXPECT_NEAR(driven, 0.624 * draws, 0.01 * draws);  // six standard deviations
}

TEST(Elites, EveryEliteIsAParent) {
  Elites elites;
  for (Cell cell = 0; cell < 100; ++cell) elites.offer(input_of(cell), in_cells({cell}, cell, 0, true));
  Random random(20260101, 1);
  std::map<const Elite*, int> drawn;
  for (int i = 0; i < 10000; ++i) ++drawn[elites.parent(random)];
  EXPECT_EQ(drawn.size(), 100u);
  EXPECT_GT(drawn[elites.at(99)], drawn[elites.at(0)]);
}

// ---- laws

// Features that follow from the input alone, with few cells and few scores: many ties.
Features made_up(const FuzzInput& input) {
  Random random(static_cast<std::uint64_t>(input.ray.origin.x), 9);
  Features f{.error = static_cast<double>(random.below(4)),
             .severity = static_cast<double>(random.below(4)),
             .nominal = random.chance(2),
             .cells = {}};
  std::set<Cell> cells;
  for (auto n = random.below(5); n > 0; --n)
    cells.insert(random.chance(3) ? signature_cell | static_cast<Cell>(random.below(8))
                                  : static_cast<Cell>(random.chance(8) ? worst_nominal_cell : random.below(16)));
  for (const Cell cell : cells) f.cells[f.size++] = cell;
  return f;
}

Elites made_up_archive(std::uint64_t first, std::uint64_t last) {
  Elites elites;
  for (; first < last; ++first) {
    const FuzzInput input = input_of(static_cast<double>(first));
    elites.offer(input, made_up(input));
  }
  return elites;
}

Elites plus(Elites x, const Elites& y) {
  for (const Elite& elite : y.all()) x.offer(elite.input, made_up(elite.input));
  return x;
}

void expect_same(const Elites& x, const Elites& y) {
  ASSERT_EQ(fingerprint(x), fingerprint(y));
  ASSERT_EQ(x.all().size(), y.all().size());
  for (const Elite& elite : x.all()) {
    const Elite* other = y.at(elite.cell);
    ASSERT_NE(other, nullptr) << elite.cell;
    ASSERT_EQ(elite.input, other->input) << elite.cell;
    ASSERT_EQ(elite.score, other->score) << elite.cell;
    ASSERT_EQ(elite.drive, other->drive) << elite.cell;
  }
}

TEST(Elites, MergingIsAssociativeCommutativeIdempotent) {
  std::set<std::uint64_t> results;
  for (std::uint64_t at = 0; at < 200; ++at) {
    SCOPED_TRACE(at);
    const std::uint64_t first = 1000 * at, size = at % 20;
    const Elites x = made_up_archive(first, first + size), y = made_up_archive(first + size / 2, first + 2 * size),
                 z = made_up_archive(first + 300, first + 303);
    ASSERT_NO_FATAL_FAILURE(expect_same(plus(plus(x, y), z), plus(x, plus(y, z))));
    ASSERT_NO_FATAL_FAILURE(expect_same(plus(x, y), plus(y, x)));
    ASSERT_NO_FATAL_FAILURE(expect_same(plus(x, x), x));
    ASSERT_NO_FATAL_FAILURE(expect_same(plus(x, Elites()), x));
    ASSERT_NO_FATAL_FAILURE(expect_same(plus(x, y), made_up_archive(first, first + 2 * size)));
    results.insert(fingerprint(plus(plus(x, y), z)));
  }
  EXPECT_GT(results.size(), 150u);
}

TEST(Elites, MergedHalvesOfACampaignAreTheWhole) {
  for (const Space space : {Space::ray, Space::target}) {
    SCOPED_TRACE(name(space));
    CampaignPlan plan = plan_for("moller_trumbore_f32", 20260101);
    plan.space = space;
    Campaign whole(plan), first(plan), second(plan);
    for (int i = 0; i < 6000; ++i) {
      const FuzzInput input = whole.next();
      whole.test(input);
      (i < 3000 ? first : second).recall(input);
    }
    EXPECT_GT(whole.elites().all().size(), 200u);
    EXPECT_NE(fingerprint(first.elites()), fingerprint(whole.elites()));
    EXPECT_NE(fingerprint(second.elites()), fingerprint(whole.elites()));
    expect_same(merged(plan, first.elites(), second.elites()), whole.elites());
    expect_same(merged(plan, second.elites(), first.elites()), whole.elites());
    expect_same(merged(plan, whole.elites(), whole.elites()), whole.elites());
  }
}

}  // namespace
}  // namespace plumbline
