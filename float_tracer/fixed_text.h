// Text of bounded length, in memory that another process reads.
#pragma once
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace plumbline {

/// Ended by a zero, cut off where it doesn't fit.
inline void copy_text(std::string_view text, std::span<char> to) { to[text.copy(to.data(), to.size() - 1)] = 0; }

/// What was copied, whatever the other process has made of it since.
inline std::string text_in(std::span<const char> from) { return {from.data(), strnlen(from.data(), from.size())}; }

}  // namespace plumbline
