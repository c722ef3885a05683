#include "float_tracer/child_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

#include "case/input_error.h"

namespace plumbline {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t longest_line = std::size_t{1} << 20;
constexpr milliseconds grace{1000};  // to end by itself when its input ends

int milliseconds_until(ChildProgram::Clock::time_point deadline) {
  const auto left = std::chrono::ceil<milliseconds>(deadline - ChildProgram::Clock::now()).count();
  return static_cast<int>(std::clamp<decltype(left)>(left, 0, 1'000'000'000));
}

struct Pipe {
  int read = -1, write = -1;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw InputError(fmt::format("a pipe cannot be made: {}; use fewer threads", std::strerror(errno)));
  return {ends[0], ends[1]};
}

void without_blocking(int descriptor) { fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK); }

pid_t spawn(const std::string& command, int input, int output) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);

  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);

  std::string shell = "sh", option = "-c", text = command;
  const std::array<char*, 4> words = {shell.data(), option.data(), text.data(), nullptr};
  pid_t process = -1;
  const int error = posix_spawn(&process, "/bin/sh", &files, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  errno = error;
  return error == 0 ? process : -1;
}

}  // namespace

ChildProgram::ChildProgram(const std::string& command) {
  const Pipe to = make_pipe(), from = make_pipe();
  process_ = spawn(command, to.read, from.write);
  const int error = errno;
  close(to.read);
  close(from.write);
  input_ = to.write;
  output_ = from.read;
  if (process_ < 0) {
    close(input_);
    close(output_);
    throw InputError(fmt::format("'{}' cannot be started: {}; use fewer threads", command, std::strerror(error)));
  }
  without_blocking(input_);
  without_blocking(output_);
}

ChildProgram::~ChildProgram() {
  close_input();
  kill();
  close(output_);
}

void ChildProgram::send(std::string_view text) {
  unsent_.erase(0, sent_);
  sent_ = 0;
  unsent_ += text;
}

ChildProgram::Got ChildProgram::next_line(std::string& line, Clock::time_point deadline) {
  for (std::size_t searched = 0;;) {
    const std::size_t end = unread_.find('\n', searched);
    searched = unread_.size();
    if (end != unread_.npos) {
      line.assign(unread_, 0, end);
      unread_.erase(0, end + 1);
      return Got::line;
    }
    if (at_end_) {
      if (unread_.empty()) return Got::end;
      line = std::move(unread_);
      unread_.clear();
      return Got::line;
    }
    if (unread_.size() > longest_line) return Got::endless;

    const bool writing = input_ >= 0 && sent_ < unsent_.size();
    std::array<pollfd, 2> ready = {{{output_, POLLIN, 0}, {writing ? input_ : -1, POLLOUT, 0}}};
    const int count = poll(ready.data(), ready.size(), milliseconds_until(deadline));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return Got::late;
    if (ready[1].revents != 0) write_some();
    if (ready[0].revents != 0) read_some();
  }
}

bool ChildProgram::has_more() {
  read_some();
  return !unread_.empty();
}

bool ChildProgram::finish() {
  close_input();
  bool said = !unread_.empty();
  std::string line;
  const auto deadline = Clock::now() + grace;
  while (next_line(line, deadline) == Got::line) said = true;
  wait_until(deadline);
  return said;
}

std::string ChildProgram::end_of_it() {
  close_input();
  if (process_ > 0 && !wait_until(Clock::now() + grace)) {
    kill();
    return "it closed its output, and was killed";
  }
  const int code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 0;
  // The shell tells the end of what it started by a signal so.
  const int signal = WIFSIGNALED(status_) ? WTERMSIG(status_) : code > 128 && code < 128 + NSIG ? code - 128 : 0;
  if (signal != 0) return fmt::format("signal {}: {}", signal, strsignal(signal));
  return fmt::format("exit code {}", code);
}

// False: nothing was there.
bool ChildProgram::read_some() {
  std::array<char, 1 << 16> chunk;
  ssize_t got = 0;
  do got = read(output_, chunk.data(), chunk.size());
  while (got < 0 && errno == EINTR);
  if (got > 0) unread_.append(chunk.data(), static_cast<std::size_t>(got));
  at_end_ = at_end_ || got == 0;
  return got > 0;
}

void ChildProgram::write_some() {
  const ssize_t wrote = write(input_, unsent_.data() + sent_, unsent_.size() - sent_);
  if (wrote > 0) sent_ += static_cast<std::size_t>(wrote);
  if (wrote < 0 && errno != EAGAIN && errno != EINTR) close_input();  // it reads no more; it may still answer
}

void ChildProgram::close_input() {
  if (input_ >= 0) close(input_);
  input_ = -1;
}

// Whether it has ended.
bool ChildProgram::wait_until(Clock::time_point deadline) {
  while (process_ > 0) {
    const pid_t ended = waitpid(process_, &status_, WNOHANG);
    if (ended == process_) {
      ::kill(-process_, SIGKILL);  // what it started and left behind
      process_ = -1;
    } else if (Clock::now() >= deadline) {
      return false;
    } else {
      std::this_thread::sleep_for(milliseconds(1));
    }
  }
  return true;
}

void ChildProgram::kill() {
  if (process_ <= 0) return;
  ::kill(-process_, SIGKILL);
  while (waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

}  // namespace plumbline
