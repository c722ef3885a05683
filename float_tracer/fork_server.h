// Starts child processes that run code under test, and ends them.
//
// They are forked not by us but by a process that is forked once, early, and does nothing else:
// - it has one thread, so that a child finds no lock held by a thread that it hasn't;
// - its memory is small and stays so: forking it again is cheap;
// - PR_SET_PDEATHSIG goes off when the *thread* that forked ends, which for a thread of ours may be soon.
// Between its own fork, which may come from any thread, and the first child it makes system calls only. Code under
// test has never run in our process then, so none of its locks is held either; malloc's are glibc's business.
//
// The process and its children hold no file of ours: standard input, output and error are /dev/null, everything else
// is closed. They are in a session of their own, where Ctrl-C doesn't reach them, with every signal at its default,
// and without core dumps. The children end with the server, the server with us, however we end.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "float_tracer/descriptor.h"

namespace plumbline {

class ForkServer {
 public:
  /// What a child does with the two descriptors that it is given. It exits when this returns.
  using Work = std::function<void(Descriptor socket, Descriptor memory)>;

  /// Throws std::system_error where there can be no process.
  explicit ForkServer(Work work);
  ~ForkServer();
  ForkServer(const ForkServer&) = delete;
  ForkServer& operator=(const ForkServer&) = delete;

  /// A new child, which gets copies of the two descriptors; -1 if there can't be one. Thread-safe, as is `end`.
  pid_t start(int socket, int memory);

  /// Kills the child, and what it has started, if it still lives. How it died, as waitpid tells it; no value if the
  /// server itself is gone.
  std::optional<int> end(pid_t child);

 private:
  std::mutex mutex_;
  Descriptor control_;
  pid_t server_ = -1, owner_;
};

/// Whether there is something to read on a child's socket, or nobody left to write it, before the time is over.
bool wait_for(const Descriptor& socket, std::chrono::milliseconds timeout);

/// "SIGABRT", "exit code 3": a status of ForkServer::end.
std::string cause_of_death(int status);

/// "no answer within 10 s".
std::string overdue(std::chrono::milliseconds timeout);

}  // namespace plumbline
