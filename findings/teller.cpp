#include "findings/teller.h"

#include "case/input_error.h"

namespace plumbline {

void Teller::tell(Event event) {
  untold_.push_back(std::move(event));
  try {
    finish();
  } catch (const InputError&) {  // finish() is called at the end, and says so
  }
}

void Teller::finish() {
  while (!untold_.empty()) {
    journal_.tell(untold_.front());
    untold_.pop_front();
  }
}

}  // namespace plumbline
