#include "findings/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>
#include <tuple>

#include "case/input_error.h"
#include "findings/event_line.h"

namespace plumbline {
namespace {

constexpr std::string_view head_begin = R"({"journal":"plumbline findings 1","id":")";
constexpr std::string_view head_end = "\"}\n";
constexpr std::size_t identity_size = 16;
constexpr std::size_t head_size = head_begin.size() + identity_size + head_end.size();

// Held as long as it lives. A signal on the way, such as Ctrl-C, is no reason to do without.
class Lock {
 public:
  Lock(int file, int how) : file_(file) {
    while (flock(file_, how) != 0 && errno == EINTR) {
    }
  }
  ~Lock() { flock(file_, LOCK_UN); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int file_;
};

std::uint64_t size_of(int file) { return static_cast<std::uint64_t>(lseek(file, 0, SEEK_END)); }

std::string new_head() {
  std::random_device random;
  return fmt::format("{}{:08x}{:08x}{}", head_begin, random(), random(), head_end);
}

bool exists(const std::string& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

}  // namespace

Journal::Journal(const std::string& store, Open how) : path_(store + ".ndjson") {
  constexpr int flags = O_RDWR | O_APPEND | O_CLOEXEC;
  file_ = open(path_.c_str(), flags);
  if (file_ < 0 && errno == ENOENT) {
    std::error_code error;
    if (exists(store) && std::filesystem::file_size(store, error) != 0)
      throw InputError(
          fmt::format("{}: there is no journal {} beside it, which holds the findings of a store; put that "
                      "back, or name another file",
                      store, path_));
    if (how == Open::existing)
      throw InputError(
          fmt::format("{}: no such store of findings; 'plumbline fuzz --findings {}' makes one", store, store));
    file_ = open(path_.c_str(), flags | O_CREAT, 0666);
  }
  if (file_ < 0) throw InputError(fmt::format("{}: can't be opened for writing: {}; name another, or a copy", path_, std::strerror(errno)));
  try {
    {
      const Lock lock(file_, LOCK_EX);
      // A beginning of the line on top is what a killed writer left of it.
      if (counted_bytes() == 0 && new_head().starts_with(bytes(0, std::min(size_of(file_), head_begin.size()))))
        append(new_head());
    }
    head_ = bytes(0, head_size);
    if (head_.size() != head_size || !head_.starts_with(head_begin) || !head_.ends_with(head_end))
      throw InputError(
          fmt::format("{}:1: this is no journal of findings; name another store, or move the file away", path_));
    identity_ = head_.substr(head_begin.size(), identity_size);
  } catch (...) {
    close(file_);
    throw;
  }
}

Journal::~Journal() {
  if (unsynced_) std::ignore = fdatasync(file_);
  close(file_);
}

void Journal::tell(const Event& event) {
  const std::string line = to_line(event);
  const Lock lock(file_, LOCK_EX);
  append(line);
}

// Under the lock. One write: a process that is killed leaves all of the line or the beginning of it.
void Journal::append(std::string_view line) {
  const std::uint64_t end = counted_bytes();
  if (end != size_of(file_) && ftruncate(file_, static_cast<off_t>(end)) != 0) fail(std::strerror(errno));
  const ssize_t written = write(file_, line.data(), line.size());
  if (written == static_cast<ssize_t>(line.size()) && sync_now_and_then()) return;
  const char* const why =
      written >= 0 && written < static_cast<ssize_t>(line.size()) ? "the disk is full" : std::strerror(errno);
  std::ignore = ftruncate(file_, static_cast<off_t>(end));
  fail(why);
}

// A search tells some hundred findings in its first second, and a disk takes milliseconds for each.
bool Journal::sync_now_and_then() {
  const auto now = Clock::now();
  unsynced_ = now - synced_ < sync_interval;
  if (unsynced_) return true;
  synced_ = now;
  return fdatasync(file_) == 0;
}

void Journal::fail(std::string_view what) const {
  throw InputError(
      fmt::format("{}: can't be written: {}; make room: nothing that was told before is lost", path_, what));
}

std::uint64_t Journal::end() const {
  const Lock lock(file_, LOCK_SH);  // a writer that fails takes back what it wrote
  return counted_bytes();
}

// The end of the last line that has its newline.
std::uint64_t Journal::counted_bytes() const {
  constexpr std::uint64_t step = 1 << 12;
  for (std::uint64_t end = size_of(file_); end > 0;) {
    const std::uint64_t begin = end - std::min(end, step);
    const std::string part = bytes(begin, end);
    if (const auto at = part.rfind('\n'); at != part.npos) return begin + at + 1;
    end = begin;
  }
  return 0;
}

// Fewer, where the file ends before.
std::string Journal::bytes(std::uint64_t from, std::uint64_t to) const {
  std::string all(to - from, '\0');
  std::size_t got = 0;
  while (got < all.size()) {
    const ssize_t n = pread(file_, all.data() + got, all.size() - got, static_cast<off_t>(from + got));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw InputError(fmt::format("{}: can't be read: {}", path_, std::strerror(errno)));
    if (n == 0) break;
    got += static_cast<std::size_t>(n);
  }
  all.resize(got);
  return all;
}

void Journal::read(JournalPlace from, const std::function<void(std::string_view, JournalPlace)>& take) const {
  const std::uint64_t end = this->end();  // what counts now stays as it is
  if (from.bytes == 0) from = {head_size, 1};
  if (from.bytes > end || bytes(from.bytes - 1, from.bytes) != "\n")
    throw InputError(fmt::format("{}: has been cut off or changed", path_));
  constexpr std::uint64_t step = 1 << 20;
  std::string part;
  for (std::uint64_t at = from.bytes; at < end;) {
    const std::string more = bytes(at, std::min(at + step, end));
    if (more.empty()) throw InputError(fmt::format("{}: became shorter while it was read", path_));
    part += more;
    at += more.size();
    std::string_view rest = part;
    for (auto newline = rest.find('\n'); newline != rest.npos; newline = rest.find('\n')) {
      from = {from.bytes + newline + 1, from.lines + 1};
      take(rest.substr(0, newline), from);
      rest.remove_prefix(newline + 1);
    }
    part.erase(0, part.size() - rest.size());
  }
}

}  // namespace plumbline
