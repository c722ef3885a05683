// The journal: what is told is there, torn lines are cut off, nothing else is ever changed.
#include "findings/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include "case/input_error.h"
#include "findings/event_line.h"
#include "findings/event_reader.h"
#include "tests/case/error_of.h"
#include "tests/findings/told.h"
#include "tests/fuzz/scratch.h"

namespace plumbline {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class JournalTest : public testing::Test {
 protected:
  std::string store() const { return scratch_.path() / "found.db"; }
  std::string file() const { return store() + ".ndjson"; }
  std::string content() const {
    std::ifstream in(file());
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void append(std::string_view text) const { std::ofstream(file(), std::ios::app) << text; }

  static std::vector<std::string> lines(const Journal& journal, JournalPlace from = {}) {
    std::vector<std::string> all;
    journal.read(from, [&](std::string_view line, JournalPlace) { all.emplace_back(line); });
    return all;
  }
  static std::string line_of(const Event& event) {
    std::string line = to_line(event);
    line.pop_back();
    return line;
  }

 private:
  Scratch scratch_;
};

TEST_F(JournalTest, MustBeThereUnlessItIsToBeMade) {
  EXPECT_THAT(error_of([&] { Journal(store(), Open::existing); }),
              AllOf(HasSubstr(store()), HasSubstr("--findings")));
  const std::string identity = Journal(store(), Open::create).identity();
  EXPECT_EQ(Journal(store(), Open::existing).identity(), identity);
  EXPECT_EQ(Journal(store(), Open::create).identity(), identity);
}

TEST_F(JournalTest, KeepsEventsInOrder) {
  Journal journal(store(), Open::create);
  EXPECT_THAT(lines(journal), ElementsAre());
  const Event one = told("t", "s", 1, 2), two = search_of("t");
  journal.tell(one);
  journal.tell(two);
  EXPECT_THAT(lines(journal), ElementsAre(line_of(one), line_of(two)));
}

TEST_F(JournalTest, IsReadOnFromWhereItWas) {
  Journal journal(store(), Open::create);
  JournalPlace place;
  journal.tell(search_of("one"));
  journal.read({}, [&](std::string_view, JournalPlace behind) { place = behind; });
  EXPECT_EQ(place.lines, 2u);  // with the one on top
  journal.tell(search_of("two"));
  EXPECT_THAT(lines(journal, place), ElementsAre(line_of(search_of("two"))));
  EXPECT_THAT(error_of([&] { lines(journal, {place.bytes - 1, 2}); }), HasSubstr("cut off or changed"));
  EXPECT_THAT(error_of([&] { lines(journal, {place.bytes + 10000, 2}); }), HasSubstr("cut off or changed"));
}

TEST_F(JournalTest, CutsOffATornLine) {
  Journal journal(store(), Open::create);
  journal.tell(search_of("one"));
  append("{\"event\":\"fin");
  EXPECT_THAT(lines(journal), ElementsAre(line_of(search_of("one"))));
  journal.tell(search_of("two"));
  EXPECT_THAT(lines(journal), ElementsAre(line_of(search_of("one")), line_of(search_of("two"))));
}

TEST_F(JournalTest, MendsATornLineOnTop) {
  append("{\"journal\":\"plum");
  Journal journal(store(), Open::create);
  journal.tell(search_of("one"));
  EXPECT_THAT(lines(journal), ElementsAre(line_of(search_of("one"))));
}

TEST_F(JournalTest, LeavesOtherFilesAlone) {
  for (const std::string other : {"no newline", "{\"id\":1}\n", "\n"}) {
    std::ofstream(file()) << other;
    EXPECT_THAT(error_of([&] { Journal(store(), Open::create); }),
                AllOf(HasSubstr(file() + ":1"), HasSubstr("no journal")));
    EXPECT_EQ(content(), other);
  }
}

TEST_F(JournalTest, IsNotMadeForADatabaseThatHasLostIts) {
  std::ofstream(store()) << "a database";
  EXPECT_THAT(error_of([&] { Journal(store(), Open::create); }), HasSubstr("no journal"));
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(JournalTest, LosesNothingOnAFullDisk) {
  Journal journal(store(), Open::create);
  journal.tell(search_of("one"));
  const std::string before = content();
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  for (const std::size_t room : {std::size_t{0}, std::size_t{10}}) {  // nothing, and a part of the line
    rlimit full = limit;
    full.rlim_cur = before.size() + room;
    setrlimit(RLIMIT_FSIZE, &full);
    EXPECT_THAT(error_of([&] { journal.tell(search_of("two")); }), AllOf(HasSubstr(file()), HasSubstr("make room")));
    setrlimit(RLIMIT_FSIZE, &limit);
    EXPECT_EQ(content(), before);
  }
  journal.tell(search_of("three"));
  EXPECT_THAT(lines(journal), ElementsAre(line_of(search_of("one")), line_of(search_of("three"))));
}

TEST_F(JournalTest, TakesManyWriters) {
  constexpr int writers = 4, each = 25;
  Journal(store(), Open::create);
  std::vector<std::thread> threads;
  for (int w = 0; w < writers; ++w)
    threads.emplace_back([&, w] {
      Journal journal(store(), Open::existing);
      for (int i = 0; i < each; ++i) journal.tell(told(std::to_string(w), std::to_string(i), 1, 1));
    });
  for (auto& thread : threads) thread.join();
  EventReader reader;
  std::vector<int> next(writers);  // each writer's in its own order
  for (const std::string& line : lines(Journal(store(), Open::existing))) {
    const FoundFinding f = std::get<FoundFinding>(reader.read(line));
    EXPECT_EQ(f.signature, std::to_string(next[std::stoul(f.tracer)]++));
  }
  EXPECT_EQ(next, std::vector<int>(writers, each));
}

TEST(EventLine, ReadsBackEqual) {
  FoundFinding f =
      told("pipe:./x \"y\"\n<script>'; DROP TABLE finding; --\x1b[2J", "false-hit-bc-nominal-c1", 0x1.8p-3, 7, -0.0);
  f.found.what.ray.t_max = 0x1.23456789abcdep+10;
  f.found.what.aim = Aim{.target = TargetKind::tolerance, .tolerance = 0.1, .standoff = 5, .wish = Wish::hit};
  EventReader reader;
  const FoundFinding back = std::get<FoundFinding>(reader.read(to_line(f)));
  EXPECT_EQ(back.tracer, f.tracer);
  EXPECT_EQ(back.signature, f.signature);
  EXPECT_EQ(back.kind, f.kind);
  EXPECT_EQ(back.element, f.element);
  EXPECT_EQ(back.found.ulps, f.found.ulps);
  EXPECT_EQ(back.found.bits, f.found.bits);
  EXPECT_EQ(back.found.what.bag, f.found.what.bag);
  EXPECT_EQ(back.found.what.ray, f.found.what.ray);
  EXPECT_TRUE(std::signbit(back.found.what.ray.origin.x));
  EXPECT_EQ(back.found.what.aim, f.found.what.aim);
  EXPECT_EQ(to_line(back), to_line(f));
}

TEST(EventLine, HoldsAnInfiniteSeverity) {
  EventReader reader;
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(std::get<FoundFinding>(reader.read(to_line(told("t", "s", infinite, 1)))).found.ulps, infinite);
}

TEST(EventLine, SaysWhatIsWrong) {
  EventReader reader;
  const std::string good = to_line(told("t", "s", 1, 2));
  const auto changed = [&good](std::string_view from, std::string_view to) {
    std::string line = good;
    return line.replace(line.find(from), from.size(), to);
  };
  for (const auto& [line, part] : {std::pair{std::string("{"), "parse error"},
                                   {std::string("[]"), "event"},
                                   {changed("\"finding\"", "\"finden\""), "finden"},
                                   {changed("\"false-hit\"", "\"false\""), "kind"},
                                   {changed("\"severity_ulps\":1", "\"severity_ulps\":-1"), "severity_ulps"},
                                   {changed("\"bits\":2", "\"bits\":-2"), "bits"},
                                   {changed("\"tracer\"", "\"trace\""), "tracer"},
                                   {changed("\"direction\"", "\"directing\""), "directing"}})
    EXPECT_THAT(error_of([&] { reader.read(line); }), HasSubstr(part)) << line;
}

}  // namespace
}  // namespace plumbline
