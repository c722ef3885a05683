// Where in a file something is, for messages that an editor can jump to.
#pragma once
#include <cstddef>
#include <string_view>

namespace plumbline {

struct Place {
  std::string_view file;
  std::size_t line = 0, column = 0;  ///< from 1, the column in bytes
};

/// Throws InputError "file:line:column: message", of which what is not printable, quoted from the file, is escaped.
[[noreturn]] void fail(const Place& place, std::string_view message);

}  // namespace plumbline
