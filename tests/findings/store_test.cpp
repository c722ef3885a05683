// The fold of events into rows, and that it is the same however often, and after whatever, it is made.
#include "findings/store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "case/input_error.h"
#include "findings/collector.h"
#include "tests/case/error_of.h"
#include "tests/findings/told.h"
#include "tests/fuzz/scratch.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class StoreTest : public testing::Test {
 protected:
  std::string path() const { return scratch_.path() / "found.db"; }
  FindingStore made() const { return FindingStore(path(), Open::create); }
  void append(std::string_view text) const { std::ofstream(path() + ".ndjson", std::ios::app) << text; }

  // All that a store tells, as text.
  std::string all() const {
    FindingStore store(path());
    std::string text;
    for (const FindingRow& r : store.rows()) {
      text += std::to_string(r.id) + r.tracer + r.signature + std::string(name(r.status)) + std::to_string(r.count) +
              std::to_string(r.duplicate_of) + r.first_seen + r.last_seen + std::to_string(r.is_new);
      for (const FoundCase& c : {r.worst, r.simplest})
        text += std::to_string(c.ulps) + std::to_string(c.bits) + std::to_string(c.what.ray.origin.x);
      for (const std::string& build : r.builds) text += build;
    }
    for (const SearchRow& s : store.searches()) text += s.tracer + s.ended + std::to_string(s.executions);
    return text;
  }

 private:
  Scratch scratch_;
};

TEST_F(StoreTest, IsEmptyAtFirst) {
  FindingStore store = made();
  EXPECT_THAT(store.rows(), IsEmpty());
  EXPECT_THAT(store.searches(), IsEmpty());
  EXPECT_FALSE(store.row(1));
  EXPECT_THAT(error_of([&] { store.set_status(1, FindingStatus::fixed, 0, "person"); }), HasSubstr("no finding 1"));
}

TEST_F(StoreTest, HasARowForEachSignatureOfEachTracer) {
  FindingStore store = made();
  for (const auto& [tracer, signature] : {std::pair{"a", "s"}, {"b", "s"}, {"a", "r"}, {"a", "s"}})
    store.tell(told(tracer, signature, 1, 1));
  std::vector<std::string> seen;
  for (std::int64_t id = 1; id <= 3; ++id) seen.push_back(store.row(id)->tracer + store.row(id)->signature);
  EXPECT_THAT(seen, ElementsAre("as", "bs", "ar"));  // in the order of finding
  EXPECT_EQ(store.row(1)->count, 2u);
  EXPECT_FALSE(store.row(4));
}

TEST_F(StoreTest, KeepsTheWorstAndTheSimplestCase) {
  FindingStore store = made();
  store.tell(told("t", "s", 5, 50, 1));
  store.tell(told("t", "s", 9, 90, 2));
  store.tell(told("t", "s", 1, 10, 3));
  store.tell(told("t", "s", 9, 10, 4));  // as bad and as simple: the first stays
  const FindingRow row = *store.row(1);
  EXPECT_EQ(row.worst.ulps, 9);
  EXPECT_EQ(row.worst.bits, 90u);
  EXPECT_EQ(row.worst.what.ray.origin.x, 2);
  EXPECT_EQ(row.simplest.ulps, 1);
  EXPECT_EQ(row.simplest.bits, 10u);
  EXPECT_EQ(row.simplest.what.ray.origin.x, 3);
}

TEST_F(StoreTest, SaysOfACaseWhatItIs) {
  FindingStore store = made();
  store.tell(told("t", "false-hit-bc-nominal-c1", 5, 50));
  const Case what = store.row(1)->worst.what;
  EXPECT_EQ(what.id, "false-hit-bc-nominal-c1");
  EXPECT_THAT(what.provenance, ElementsAre("false-hit of t", "severity 5 ulps of the largest coordinate, nominal",
                                           "found 2026-01-01T00:00:00Z by a test, with a build"));
  EXPECT_EQ(what.expect->hit_class, HitClass::exterior);
  EXPECT_THAT(what.known, ElementsAre(Known{"t", VerdictKind::false_hit}));
}

TEST_F(StoreTest, ListsTheNominalFirstTheWorstFirst) {
  FindingStore store = made();
  store.tell(told("t", "mild", 1, 1));
  store.tell(told("t", "bad", 7, 1));
  FoundFinding far = told("t", "far", 1e9, 1);
  far.conditioning = Conditioning::far;
  store.tell(far);
  std::vector<std::string> order;
  for (const FindingRow& row : store.rows({.details = false})) order.push_back(row.signature);
  EXPECT_THAT(order, ElementsAre("bad", "mild", "far"));
}

TEST_F(StoreTest, NamesBuildsOnceAndTheFirstAndLastTime) {
  FindingStore store = made();
  for (const auto& [build, seen] :
       {std::pair{"one", "2026-01-01T00:00:00Z"}, {"two", "2026-01-02T00:00:00Z"}, {"one", "2026-01-03T00:00:00Z"}}) {
    FoundFinding f = told("t", "s", 1, 1);
    f.build = build;
    f.seen = seen;
    store.tell(f);
  }
  EXPECT_THAT(store.row(1)->builds, ElementsAre("one", "two"));
  EXPECT_EQ(store.row(1)->first_seen, "2026-01-01T00:00:00Z");
  EXPECT_EQ(store.row(1)->last_seen, "2026-01-03T00:00:00Z");
}

TEST_F(StoreTest, SettlesAndReopens) {
  FindingStore store = made();
  store.tell(told("t", "one", 1, 1));
  store.tell(told("t", "two", 1, 1));
  store.set_status(2, FindingStatus::duplicate, 1, "person");
  EXPECT_EQ(store.row(2)->status, FindingStatus::duplicate);
  EXPECT_EQ(store.row(2)->duplicate_of, 1);
  store.tell(told("t", "two", 2, 1));  // what is settled otherwise than as fixed stays so
  EXPECT_EQ(store.row(2)->status, FindingStatus::duplicate);
  store.set_status(2, FindingStatus::wontfix, 0, "person");
  EXPECT_EQ(store.row(2)->duplicate_of, 0);
  store.set_status(1, FindingStatus::fixed, 0, "person");
  EXPECT_THAT(store.rows({.only_open = true}), IsEmpty());
  store.tell(told("t", "one", 1, 1));  // found again
  EXPECT_EQ(store.row(1)->status, FindingStatus::open);
  EXPECT_THAT(error_of([&] { store.set_status(1, FindingStatus::duplicate, 1, "person"); }), HasSubstr("of itself"));
  EXPECT_THAT(error_of([&] { store.set_status(1, FindingStatus::duplicate, 9, "person"); }),
              HasSubstr("no finding 9"));
}

TEST_F(StoreTest, TellsWhatIsNewSinceTheLastSearchButOne) {
  FindingStore store = made();
  const auto fresh = [&store] {
    std::vector<std::string> names;
    for (const FindingRow& row : store.rows({.only_new = true})) names.push_back(row.signature);
    return names;
  };
  store.tell(told("t", "1", 1, 1));
  EXPECT_THAT(fresh(), ElementsAre("1"));
  store.tell(search_of("t"));
  EXPECT_THAT(fresh(), ElementsAre("1"));
  store.tell(told("t", "2", 1, 1));
  store.tell(search_of("t"));
  store.tell(search_of("other"));  // not of this tracer
  store.tell(search_of("other"));
  EXPECT_THAT(fresh(), ElementsAre("2"));
  store.tell(told("t", "1", 1, 1));  // is none
  store.tell(search_of("t"));
  EXPECT_THAT(fresh(), IsEmpty());
}

TEST_F(StoreTest, IsTheSameWhenTheDatabaseIsGoneOrRebuilt) {
  {
    FindingStore store = made();
    for (int i = 0; i < 30; ++i)
      store.tell(told("t" + std::to_string(i % 3), "s" + std::to_string(i % 7), i, 100 - i, i));
    store.tell(search_of("t1", 1000));
    store.set_status(4, FindingStatus::duplicate, 2, "person");
    store.set_status(3, FindingStatus::fixed, 0, "retest");
  }
  const std::string before = all();
  for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(path() + suffix);
  EXPECT_EQ(all(), before);
  EXPECT_THAT(rebuild(path()), IsEmpty());
  EXPECT_EQ(all(), before);
  EXPECT_TRUE(fs::exists(path() + ".old"));
}

TEST_F(StoreTest, TakesInWhatOthersTell) {
  FindingStore store = made();
  Journal(path(), Open::existing).tell(told("t", "s", 1, 1));
  EXPECT_THAT(store.rows(), SizeIs(1));
  FindingStore(path()).set_status(1, FindingStatus::invalid, 0, "person");
  EXPECT_EQ(store.row(1)->status, FindingStatus::invalid);
}

TEST_F(StoreTest, NamesADamagedLineAndGoesOnWhenRebuilt) {
  made().tell(told("t", "one", 1, 1));
  append("{\"event\":\"finding\",\"tracer\":\n");
  Journal(path(), Open::existing).tell(told("t", "two", 1, 1));
  EXPECT_THAT(error_of([&] { FindingStore store(path()); }),
              AllOf(HasSubstr(path() + ".ndjson:3: "), HasSubstr("triage rebuild")));
  EXPECT_THAT(rebuild(path()), ElementsAre(HasSubstr(path() + ".ndjson:3: ")));
  EXPECT_THAT(FindingStore(path()).rows(), SizeIs(2));
  std::ifstream in(path() + ".ndjson");
  std::string line;
  for (int i = 0; i < 3; ++i) std::getline(in, line);
  EXPECT_EQ(line, "{\"event\":\"finding\",\"tracer\":");
}

TEST_F(StoreTest, KeepsAStatusWithItsFindingWhereALineBeforeIsDamaged) {
  {
    FindingStore store = made();
    store.tell(told("t", "one", 1, 1));
    store.tell(told("t", "two", 1, 1));
    store.set_status(2, FindingStatus::wontfix, 0, "person");
  }
  std::ifstream in(path() + ".ndjson");
  std::string text((std::istreambuf_iterator<char>(in)), {});
  text.replace(text.find("\"finding\""), 9, "\"fin ing\"");
  std::ofstream(path() + ".ndjson") << text;
  EXPECT_THAT(rebuild(path()), SizeIs(1));
  const FindingRow row = *FindingStore(path()).row(1);
  EXPECT_EQ(row.signature, "two");
  EXPECT_EQ(row.status, FindingStatus::wontfix);
}

TEST_F(StoreTest, RefusesADatabaseThatIsNoStoreAndRebuildMendsIt) {
  made().tell(told("t", "s", 1, 1));
  const auto spoil = [this](std::string_view what) {
    for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(path() + suffix);
    if (what == "text") std::ofstream(path()) << std::string(5000, 'x');
    if (what.starts_with("PRAGMA") || what.starts_with("CREATE")) {
      FindingStore store(path());
      Database(path(), "", "").run(std::string(what).c_str());
    }
    if (what == "cut") {
      { FindingStore store(path()); }
      fs::resize_file(path(), fs::file_size(path()) / 2 / 4096 * 4096);
    }
  };
  for (const auto& [what, part] : {std::pair{"text", "not a database"},
                                   {"PRAGMA application_id = 7", "something else"},
                                   {"PRAGMA user_version = 99", "newer"},
                                   {"cut", "malformed"}}) {
    spoil(what);
    EXPECT_THAT(error_of([&] { FindingStore(path()).rows(); }),
                AllOf(HasSubstr(path()), HasSubstr(part), HasSubstr("triage rebuild")))
        << what;
    EXPECT_THAT(rebuild(path()), IsEmpty());
    EXPECT_THAT(FindingStore(path()).rows(), SizeIs(1)) << what;
  }
}

TEST_F(StoreTest, MakesAnOlderSchemaAnew) {
  made().tell(told("t", "s", 1, 1));
  Database(path(), "", "").run("PRAGMA user_version = 0");
  EXPECT_THAT(FindingStore(path()).rows(), SizeIs(1));
}

TEST_F(StoreTest, RefusesAnotherJournal) {
  made();
  fs::remove(path() + ".ndjson");
  fs::rename(path(), path() + ".away");
  made();
  fs::rename(path() + ".away", path());
  EXPECT_THAT(error_of([&] { FindingStore store(path()); }), HasSubstr("another journal"));
}

TEST_F(StoreTest, HoldsHostileNames) {
  const std::vector<std::string> names = {"pipe:./x y",
                                          "./lib.so",
                                          "a\nb",
                                          "\"'",
                                          "'; DROP TABLE finding; --",
                                          "<script>alert(1)</script>",
                                          std::string("nul\0behind", 10),
                                          "",
                                          "\x1b[2J",
                                          "%s%n{}",
                                          "../../etc/passwd"};
  FindingStore store = made();
  for (const std::string& name : names) store.tell(told(name, name + "s", 1, 1));
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(store.row(static_cast<std::int64_t>(i) + 1)->tracer, names[i]);
    if (!names[i].empty()) {
      EXPECT_THAT(store.rows({.tracer = names[i]}), SizeIs(1));
    }
  }
  store.tell(told("\xff", "s", 1, 1));  // no UTF-8
  EXPECT_EQ(store.row(static_cast<std::int64_t>(names.size()) + 1)->tracer, "\\xff");
}

TEST_F(StoreTest, IsToldByACollectorWhatIsNewOrTwiceAsSevere) {
  {
    Collector collector(path(), "sweep");
    collector.count("t", 100);
    for (const double ulps : {1.0, 1.9, 2.0, 3.0, 4.0, 0.5}) collector.add(told("t", "s", ulps, 1));
    collector.finish();
  }
  FindingStore store(path());
  EXPECT_EQ(store.row(1)->count, 3u);  // 1, 2, 4
  EXPECT_EQ(store.row(1)->worst.ulps, 4);
  const SearchRow search = store.searches().at(0);
  EXPECT_EQ(search.executions, 100u);
  EXPECT_EQ(search.worst_nominal_ulps, 4);
  EXPECT_EQ(search.signatures, 1u);
}

}  // namespace
}  // namespace plumbline
