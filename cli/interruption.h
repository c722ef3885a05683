// Ctrl-C as a wish to stop: for verbs that then print what is done.
#pragma once
#include <atomic>

namespace plumbline {

/// While it lives, the first Ctrl-C is noted, and the second does what the first did before. One at a time. To be made
/// when the files to be written are open, for these see to it that they go when a signal ends the program.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Whether it came.
  const std::atomic<bool>& came() const;
};

}  // namespace plumbline
