// Reads events from the lines of a journal.
#pragma once
#include <memory>
#include <string_view>

#include "findings/event.h"

namespace plumbline {

class EventReader {
 public:
  EventReader();
  ~EventReader();

  /// Throws InputError that says what is wrong with the line, but not where it is: the caller knows the place.
  Event read(std::string_view line);

 private:
  class Impl;  // keeps nlohmann's header out of ours
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumbline
