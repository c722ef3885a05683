// Text of any origin, such as the name that a foreign tracer gives itself, made fit for where it goes.
#pragma once
#include <string>
#include <string_view>

namespace plumbline {

/// For a terminal, and for a comment of one line: control characters and bytes that are no UTF-8 as \n, \t or \x1b.
std::string printable(std::string_view text);

/// For JSON: bytes that are no UTF-8 as \xff; all else as it is.
std::string valid_utf8(std::string_view text);

}  // namespace plumbline
