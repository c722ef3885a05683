#include "fuzz/launcher.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <set>
#include <thread>

#include "case/folder.h"
#include "case/input_error.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

pid_t start(const LaunchPlan& plan, unsigned job) {
  std::vector<std::string> words = {plan.program.string()};
  words.insert(words.end(), plan.options.begin(), plan.options.end());
  words.push_back("--campaign=" + plan.folder.string());
  words.push_back(fmt::format("--job={}", job));
  if (plan.runs) words.push_back(fmt::format("--runs={}", *plan.runs / plan.jobs + (job < *plan.runs % plan.jobs ? 1 : 0)));
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string log = plan.folder / "jobs" / fmt::format("{}.log", job);
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw InputError(fmt::format("no process can be started: {}", std::strerror(errno)));
  if (child > 0) return child;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (getppid() != parent || file < 0 || dup2(file, STDOUT_FILENO) < 0 || dup2(file, STDERR_FILENO) < 0) _exit(127);
  execv(arguments.front(), arguments.data());
  dprintf(STDERR_FILENO, "%s: %s\n", arguments.front(), std::strerror(errno));
  _exit(127);
}

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last;
}

// What is new at the end of the log of findings.
class FindingsTail {
 public:
  explicit FindingsTail(const fs::path& file) : in_(file, std::ios::ate), file_(file) {}
  std::string latest() {
    if (!in_.is_open()) in_.open(file_);
    std::string line, found;
    in_.clear();
    while (std::getline(in_, line)) {
      constexpr std::string_view mark = "\"signature\":\"";
      if (const auto at = line.find(mark); at != std::string::npos)
        found = line.substr(at + mark.size(), line.find('"', at + mark.size()) - at - mark.size());
    }
    return found;
  }

 private:
  std::ifstream in_;
  fs::path file_;
};

std::uint64_t count_cases(const fs::path& folder) {
  std::uint64_t n = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) n += entry.path().extension() == ".case";
  return n;
}

std::uint64_t count_cells(const fs::path& folder) {
  std::set<std::string> cells;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (const std::string name = entry.path().filename(); name.size() == 42) cells.insert(name.substr(0, 8));
  return cells.size();
}

// Of all processes, those of earlier calls included.
Summary together(const fs::path& folder) {
  std::optional<Summary> all;
  std::size_t jobs = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder / "jobs", error)) {
    if (entry.path().extension() != ".json") continue;
    const auto one = read_summary(entry.path());
    if (!one) continue;
    ++jobs;
    if (!all) {
      all = *one;
      continue;
    }
    all->seed = std::min(all->seed, one->seed);
    all->executions += one->executions;
    all->seconds += one->seconds;
    if (one->first_disagreement)
      all->first_disagreement = std::min(*one->first_disagreement, all->first_disagreement.value_or(*one->first_disagreement));
    all->worst_nominal_severity = std::max(all->worst_nominal_severity, one->worst_nominal_severity);
    if (one->least_margin) all->least_margin = std::min(*one->least_margin, all->least_margin.value_or(*one->least_margin));
    all->cells = std::max(all->cells, one->cells);
  }
  if (!all) return {};
  all->signatures = count_cases(folder / "findings");
  if (jobs > 1) {
    all->cells = std::max(all->cells, count_cells(folder / "elites"));
    all->fingerprint.clear();
  }
  return *all;
}

}  // namespace

Summary launch(const LaunchPlan& plan, const std::atomic<bool>& stop, const std::function<void(const LaunchStatus&)>& status) {
  make_folder(plan.folder);
  make_folder(plan.folder / "jobs");
  FindingsTail tail(plan.folder / "findings.ndjson");
  const auto begin = Clock::now();
  std::vector<pid_t> children;
  for (unsigned job = 0; job < plan.jobs; ++job) children.push_back(start(plan, job));
  std::string trouble;
  LaunchStatus now;
  auto news = begin, next = begin + std::chrono::seconds(1);
  bool told = false;
  for (std::size_t running = children.size(); running > 0;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (stop && !told) {
      for (const pid_t child : children)
        if (child > 0) kill(child, SIGTERM);
      told = true;
    }
    for (unsigned job = 0; job < children.size(); ++job) {
      int state = 0;
      if (children[job] <= 0 || waitpid(children[job], &state, WNOHANG) != children[job]) continue;
      children[job] = 0;
      --running;
      if (WIFEXITED(state) && WEXITSTATUS(state) == 0) continue;
      const fs::path log = plan.folder / "jobs" / fmt::format("{}.log", job);
      trouble = fmt::format("process {} {}: {} (more in {})", job,
                            WIFSIGNALED(state) ? fmt::format("died of {}", strsignal(WTERMSIG(state))) : "failed",
                            last_line(log), log.string());
    }
    if (Clock::now() < next) continue;
    next = Clock::now() + std::chrono::seconds(1);
    now.summary = together(plan.folder);
    now.running = std::chrono::duration<double>(Clock::now() - begin).count();
    if (std::string latest = tail.latest(); !latest.empty()) {
      now.last_new = std::move(latest);
      news = Clock::now();
    }
    now.since_last_new = std::chrono::duration<double>(Clock::now() - news).count();
    write_summary(plan.folder / "summary.json", now.summary);
    if (status) status(now);
  }
  const Summary all = together(plan.folder);
  const bool written = write_summary(plan.folder / "summary.json", all);
  if (!trouble.empty()) throw InputError(trouble);
  if (!written)
    throw InputError(fmt::format("{}: can't be written; make room and go on with the same command",
                                 (plan.folder / "summary.json").string()));
  return all;
}

fs::path fuzz_program() {
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& place : {here / "plumbline_fuzzer", here / ".." / "fuzz" / "plumbline_fuzzer"})
    if (fs::exists(place)) return fs::canonical(place);
  throw InputError(fmt::format("{}: the fuzz program is not there; build the target plumbline_fuzzer",
                               (here / "plumbline_fuzzer").string()));
}

}  // namespace plumbline
