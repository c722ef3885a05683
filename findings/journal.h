// The truth of a store: its events, one a line, in one file that only grows.
//
// The journal of a store DB is DB.ndjson: whoever has the one name has the other, and it's a text that any tool
// reads. Its first line tells what it is, and which one. A line counts when it is there with its newline; what a
// killed writer left of a line is cut off by the next one. Any number of processes may write.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "findings/event.h"

namespace plumbline {

enum class Open : unsigned char { existing, create };

/// A place between two lines: bytes and lines before it. {0, 0} is the beginning.
struct JournalPlace {
  std::uint64_t bytes = 0, lines = 0;
};

class Journal {
 public:
  /// Of the store DB, whose name is given. Throws InputError where there is none to open, or it can't be made; where
  /// there is a DB without a journal; where the file is no journal.
  Journal(const std::string& store, Open how);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// When it returns, the event is in the file, whatever becomes of the process. On the disk, for the machine to lose
  /// its power, it is with the first event told sync_interval later, or when the journal is closed. Throws InputError
  /// where it can't be written: nothing is changed then.
  void tell(const Event& event);

  /// take(line, the place behind it) for every line that counts from `from` on, the one on top not among them. Events
  /// that are told meanwhile wait for the next call. Throws InputError if `from` is no place between two lines.
  void read(JournalPlace from, const std::function<void(std::string_view line, JournalPlace behind)>& take) const;

  /// The bytes of all lines that count.
  std::uint64_t end() const;
  const std::string& path() const { return path_; }
  /// Of this journal, and of no other.
  const std::string& identity() const { return identity_; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds sync_interval{200};

  void append(std::string_view line);
  bool sync_now_and_then();
  std::uint64_t counted_bytes() const;
  std::string bytes(std::uint64_t from, std::uint64_t to) const;
  [[noreturn]] void fail(std::string_view what) const;

  std::string path_, identity_;
  std::string head_;  // the line on top
  int file_ = -1;
  Clock::time_point synced_{};
  bool unsynced_ = false;
};

}  // namespace plumbline
