// Trouble with what the user gave: a file, an option, a value. Caught once, in cli/main.cpp, which prints the message
// as one line and exits with 2.
#pragma once
#include <stdexcept>

namespace plumbline {

/// The message names the place (file:line:column, option or key), what is wrong there, and the fix.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace plumbline
