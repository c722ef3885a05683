// The archive as a folder: read back as it was, whatever else lies there, and nothing lost that can't be written.
#include "fuzz/elites_folder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <bit>
#include <csignal>
#include <fstream>
#include <map>
#include <string>

#include "case/input_error.h"
#include "fuzz/worker.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/searched.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

const CampaignPlan& plan() {
  static const CampaignPlan p = plan_for("moller_trumbore_f64", 20260101);
  return p;
}

std::vector<std::byte> bytes_of(const FuzzInput& input) {
  std::vector<std::byte> bytes(input_size(input.space, input.precision));
  encode(input, bytes);
  return bytes;
}

void write(const fs::path& file, std::span<const std::byte> bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// Searches on, noting and writing what is kept. The elites that could not be written.
std::size_t search_into(ElitesFolder& folder, Campaign& campaign, int executions) {
  campaign.on_elites = [&folder](const Elites& elites) { folder.note(elites); };
  for (int i = 0; i < executions; ++i) campaign.test(campaign.next());
  return folder.flush(campaign.elites());
}

struct Read {
  Campaign campaign{plan()};
  std::size_t inputs = 0;
};
Read read(const fs::path& path) {
  Read r;
  ElitesFolder folder(path);
  folder.scan(r.campaign.elites(), input_like(plan()), plan().domain, [&](const FuzzInput& input) {
    ++r.inputs;
    r.campaign.recall(input);
  });
  return r;
}

std::vector<std::string> names(const fs::path& path) {
  std::vector<std::string> list;
  for (const auto& entry : fs::directory_iterator(path)) list.push_back(entry.path().filename());
  return list;
}

// Writing fails as on a full disk.
class FullDisk {
 public:
  FullDisk() {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit none = before_;
    none.rlim_cur = 0;
    setrlimit(RLIMIT_FSIZE, &none);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
};

TEST(ElitesFolder, IsReadBackAsItWas) {
  const Scratch scratch;
  Campaign campaign(plan());
  ElitesFolder folder(scratch.path() / "deep" / "elites");
  EXPECT_EQ(search_into(folder, campaign, 1000), 0u);
  const Read back = read(folder.path());
  EXPECT_EQ(fingerprint(back.campaign.elites()), fingerprint(campaign.elites()));
  EXPECT_EQ(back.campaign.elites().all().size(), campaign.elites().all().size());
  EXPECT_EQ(back.campaign.executions(), 0u);
}

TEST(ElitesFolder, HoldsAFileForEachEliteAndNoOther) {
  const Scratch scratch;
  Campaign campaign(plan());
  ElitesFolder folder(scratch.path());
  for (int round = 0; round < 3; ++round) {  // later rounds replace files
    ASSERT_EQ(search_into(folder, campaign, 500), 0u);
    const auto files = names(folder.path());
    ASSERT_EQ(files.size(), campaign.elites().all().size());
    for (const std::string& file : files) {
      ASSERT_EQ(file.size(), 42u) << file;
      ASSERT_EQ(file[8], '-') << file;
      const Elite* elite = campaign.elites().at(static_cast<Cell>(std::stoul(file.substr(0, 8), nullptr, 16)));
      ASSERT_NE(elite, nullptr) << file;
      ASSERT_EQ(elite->score, std::bit_cast<double>(std::stoull(file.substr(9, 16), nullptr, 16))) << file;
      ASSERT_EQ(fingerprint(*elite), std::stoull(file.substr(26), nullptr, 16)) << file;
      ASSERT_EQ(fs::file_size(folder.path() / file), 136u) << file;
    }
  }
}

TEST(ElitesFolder, AScoreInANameIsComputedAgain) {
  const Scratch scratch;
  Campaign campaign(plan());
  ElitesFolder folder(scratch.path());
  search_into(folder, campaign, 1000);
  int renamed = 0;
  for (const std::string& file : names(folder.path())) {
    constexpr std::array<std::string_view, 3> wrong = {"7fe0000000000000", "0000000000000000", "7ff8000000000000"};
    std::string name = file;
    name.replace(9, 16, wrong[renamed++ % wrong.size()]);  // far too high, far too low, NaN
    fs::rename(folder.path() / file, folder.path() / name);
  }
  ASSERT_GT(renamed, 100);
  const Read back = read(folder.path());
  EXPECT_EQ(fingerprint(back.campaign.elites()), fingerprint(campaign.elites()));
  for (const Elite& elite : back.campaign.elites().all()) EXPECT_LT(elite.score, 0x1p+60);
}

TEST(ElitesFolder, OtherFilesOfTheRightSizeAreInputs) {
  const Scratch scratch;
  const Campaign campaign = searched(plan(), 1000);
  int n = 0;
  for (const Elite& elite : campaign.elites().all())
    write(scratch.path() / ("seed" + std::to_string(n++)), bytes_of(elite.input));
  EXPECT_EQ(fingerprint(read(scratch.path()).campaign.elites()), fingerprint(campaign.elites()));
}

TEST(ElitesFolder, StrayFilesAreLeftAlone) {
  const Scratch scratch;
  Campaign campaign(plan());
  ElitesFolder folder(scratch.path());
  search_into(folder, campaign, 1000);
  const std::size_t inputs = read(scratch.path()).inputs;
  EXPECT_GT(inputs, 0u);
  const std::vector<std::byte> bytes(137);
  for (const std::size_t size : {0, 1, 68, 135, 137})
    write(scratch.path() / ("stray" + std::to_string(size)), std::span(bytes).first(size));
  // Half of a file, well named; and of a process that was killed.
  write(scratch.path() / "00000007-4000000000000000-0123456789abcdef", std::span(bytes).first(135));
  write(scratch.path() / ".part.1", std::span(bytes).first(136));
  fs::create_directory(scratch.path() / "folder");
  fs::create_symlink("nowhere", scratch.path() / "dangling");
  const Read back = read(scratch.path());
  EXPECT_EQ(back.inputs, inputs);
  EXPECT_EQ(fingerprint(back.campaign.elites()), fingerprint(campaign.elites()));
  search_into(folder, campaign, 1000);
  for (const char* stray : {"stray0", "stray1", "stray68", "stray135", "stray137", "folder"})
    EXPECT_TRUE(fs::exists(scratch.path() / stray)) << stray;
}

TEST(ElitesFolder, AFileIsReadOnce) {
  const Scratch scratch;
  write(scratch.path() / "seed", bytes_of(Campaign(plan()).next()));
  ElitesFolder folder(scratch.path());
  int taken = 0;
  const auto scan = [&] {
    folder.scan(Elites(), input_like(plan()), Domain::nominal, [&](const FuzzInput&) { ++taken; });
  };
  scan();
  scan();
  EXPECT_EQ(taken, 1);
  write(scratch.path() / "another", bytes_of(Campaign(plan()).next()));
  scan();
  EXPECT_EQ(taken, 2);
}

TEST(ElitesFolder, WhatCannotBeWrittenStaysNoted) {
  const Scratch scratch;
  Campaign campaign(plan());
  ElitesFolder folder(scratch.path());
  {
    const FullDisk full;
    const std::size_t noted = search_into(folder, campaign, 1000);
    EXPECT_EQ(noted, campaign.elites().all().size());
    EXPECT_TRUE(names(folder.path()).empty());
  }
  EXPECT_EQ(folder.flush(campaign.elites()), 0u);
  EXPECT_EQ(fingerprint(read(scratch.path()).campaign.elites()), fingerprint(campaign.elites()));
}

// What was written before stays until what is worse can be.
TEST(ElitesFolder, AFullDiskLosesNoFile) {
  const Scratch scratch;
  Campaign campaign(plan());
  ElitesFolder folder(scratch.path());
  ASSERT_EQ(search_into(folder, campaign, 1000), 0u);
  const std::uint64_t before = fingerprint(campaign.elites());
  {
    const FullDisk full;
    EXPECT_GT(search_into(folder, campaign, 1000), 0u);
  }
  EXPECT_EQ(fingerprint(read(scratch.path()).campaign.elites()), before);
}

TEST(ElitesFolder, AFolderThatIsGoneKeepsElitesNoted) {
  const Scratch scratch;
  const fs::path path = scratch.path() / "elites";
  Campaign campaign(plan());
  ElitesFolder folder(path);
  fs::remove(path);
  const std::size_t noted = search_into(folder, campaign, 1000);
  EXPECT_EQ(noted, campaign.elites().all().size());
  folder.scan(campaign.elites(), input_like(plan()), Domain::nominal, [](const FuzzInput&) { FAIL(); });
  fs::create_directory(path);
  EXPECT_EQ(folder.flush(campaign.elites()), 0u);
  EXPECT_EQ(fingerprint(read(path).campaign.elites()), fingerprint(campaign.elites()));
}

TEST(ElitesFolder, ThrowsWhereThereCanBeNone) {
  const Scratch scratch;
  std::ofstream(scratch.path() / "file") << "text";
  for (const fs::path& path : {scratch.path() / "file", scratch.path() / "file" / "elites"}) {
    try {
      const ElitesFolder folder(path);
      FAIL() << path;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    }
  }
}

TEST(ElitesFolder, UnionOfFoldersIsTheMerge) {
  const Scratch scratch;
  std::vector<Campaign> campaigns;
  for (const std::uint64_t seed : {1, 2, 3}) {
    CampaignPlan p = plan();
    p.seed = seed;
    Campaign& campaign = campaigns.emplace_back(p);
    ElitesFolder folder(scratch.path() / std::to_string(seed));
    ASSERT_EQ(search_into(folder, campaign, 500), 0u);
    fs::copy(folder.path(), scratch.path() / "all", fs::copy_options::recursive | fs::copy_options::skip_existing);
  }
  const Elites all =
      merged(plan(), campaigns[0].elites(), merged(plan(), campaigns[1].elites(), campaigns[2].elites()));
  EXPECT_NE(fingerprint(all), fingerprint(campaigns[0].elites()));
  EXPECT_EQ(fingerprint(read(scratch.path() / "all").campaign.elites()), fingerprint(all));
}

// Of right answers without an error the score is 0.
TEST(ElitesFolder, ElitesOfEqualScoresHaveFilesOfTheirOwn) {
  const Scratch scratch;
  Campaign x(plan()), y(plan());
  ElitesFolder of_x(scratch.path()), of_y(scratch.path());
  FuzzInput one = x.next(), other = one;
  other.ray.direction.z = 0x1p+1;
  const std::pair<Campaign*, ElitesFolder*> both[] = {{&x, &of_x}, {&y, &of_y}};
  for (const auto& [campaign, folder] : both) {
    campaign->on_elites = [f = folder](const Elites& elites) { f->note(elites); };
    campaign->test(campaign == &x ? one : other);
    ASSERT_EQ(campaign->elites().all().size(), 1u);
    ASSERT_EQ(folder->flush(campaign->elites()), 0u);
  }
  ASSERT_EQ(x.elites().all()[0].cell, y.elites().all()[0].cell);
  EXPECT_EQ(names(scratch.path()).size(), 2u);
  EXPECT_EQ(fingerprint(read(scratch.path()).campaign.elites()), fingerprint(merged(plan(), x.elites(), y.elites())));
}

// Two processes with one folder: each takes over what the other wrote.
TEST(ElitesFolder, TwoWritersComeToTheSame) {
  const Scratch scratch;
  CampaignPlan other = plan();
  other.seed = 7;
  Campaign x(plan()), y(other);
  ElitesFolder of_x(scratch.path()), of_y(scratch.path());
  const auto look = [](ElitesFolder& folder, Campaign& campaign) {
    folder.scan(campaign.elites(), input_like(plan()), Domain::nominal,
                [&](const FuzzInput& input) { campaign.recall(input); });
  };
  for (int round = 0; round < 3; ++round) {
    search_into(of_x, x, 200);
    look(of_x, x);
    search_into(of_y, y, 200);
    look(of_y, y);
  }
  look(of_x, x);
  EXPECT_EQ(fingerprint(x.elites()), fingerprint(y.elites()));
  of_x.flush(x.elites());
  of_y.flush(y.elites());
  EXPECT_EQ(fingerprint(read(scratch.path()).campaign.elites()), fingerprint(x.elites()));
}

}  // namespace
}  // namespace plumbline
