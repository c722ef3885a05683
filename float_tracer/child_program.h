// A program that answers lines with lines, started by the shell. It is in a process group of its own, so that all
// that the command starts ends with it; its standard error is ours.
//
// Asks that SIGPIPE is ignored in this process: a program that reads no more is no reason to end.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <string>

namespace plumbline {

class ChildProgram {
 public:
  using Clock = std::chrono::steady_clock;

  /// Throws InputError if it can't be started; a command that the shell doesn't find ends at once instead.
  explicit ChildProgram(const std::string& command);
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;
  /// Ends it, killing it if need be.
  ~ChildProgram();

  /// To be written while lines are waited for: neither side blocks the other.
  void send(std::string_view text);

  enum class Got : unsigned char {
    line,
    end,      ///< it closed its output or ended
    late,     ///< nothing until the deadline
    endless,  ///< a line beyond 1 MiB
  };
  /// The next line, without its newline; the last may lack it.
  Got next_line(std::string& line, Clock::time_point deadline);

  /// Whether a line, or a part of it, is there already.
  bool has_more();

  /// Closes its input and gives it a moment to end by itself. True if it said something more.
  bool finish();

  /// Of a program that ended, or is ended now: "exit code 3", "signal 11: Segmentation fault".
  std::string end_of_it();

 private:
  bool read_some();
  void write_some();
  void close_input();
  bool wait_until(Clock::time_point deadline);
  void kill();

  pid_t process_ = -1;  // -1: waited for
  int status_ = 0;
  int input_ = -1, output_ = -1;  // its standard input, which we write, and its output
  std::string unsent_, unread_;
  std::size_t sent_ = 0;
  bool at_end_ = false;
};

}  // namespace plumbline
