#include "cli/part_files.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>

namespace plumbline {
namespace {

// All that a signal handler may touch: lock-free, of a fixed size.
std::array<std::atomic<const char*>, 16> parts;
static_assert(std::atomic<const char*>::is_always_lock_free);

void remove_parts_and_die(int signal) {
  for (const auto& part : parts)
    if (const char* path = part) unlink(path);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

// What is ignored (nohup) stays ignored.
bool catch_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, remove_parts_and_die) == SIG_IGN) std::signal(signal, SIG_IGN);
  return true;
}

void replace_first(const char* old, const char* path) {
  for (auto& part : parts)
    if (const char* expected = old; part.compare_exchange_strong(expected, path)) return;
}

}  // namespace

void remove_on_signal(const char* path) {
  [[maybe_unused]] static const bool caught = catch_signals();
  replace_first(nullptr, path);
}

void keep_on_signal(const char* path) { replace_first(path, nullptr); }

}  // namespace plumbline
