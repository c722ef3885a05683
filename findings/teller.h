// Tells a journal without standing in the way of the work: what can't be written waits, and is tried again.
#pragma once
#include <deque>
#include <string>

#include "findings/journal.h"

namespace plumbline {

class Teller {
 public:
  /// As Journal.
  Teller(const std::string& store, Open how) : journal_(store, how) {}

  void tell(Event event);
  /// Throws InputError, as Journal::tell, where something is still untold.
  void finish();

 private:
  Journal journal_;
  std::deque<Event> untold_;
};

}  // namespace plumbline
