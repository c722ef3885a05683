// The lines of a text mesh and their words: what stands between blanks. Private to mesh.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/float_bits.h"
#include "case/printable.h"
#include "case/real_text.h"

namespace plumbline {

inline constexpr std::string_view mesh_blanks = " \t\r\v\f";

/// Into `words`, whose storage is used again.
inline void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  std::size_t at = 0;
  while ((at = line.find_first_not_of(mesh_blanks, at)) != line.npos) {
    const std::size_t end = std::min(line.find_first_of(mesh_blanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
}

/// take(begin, end) for each line, its end excluded.
template <class Take>
void for_each_line(std::string_view bytes, Take take) {
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    take(begin, end);
    begin = end + 1;
  }
}

/// A decimal as C++ streams read it: with a '+' or without, and no hexfloat. Beyond binary64 it is infinite.
inline std::optional<double> parse_decimal(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  if (word.empty() || word.starts_with('+') || word.find_first_of("xX") != word.npos) return std::nullopt;
  return parse_real(word);
}

/// A word of a file as messages show it.
inline std::string quoted(std::string_view word) { return fmt::format("'{}'", printable(word.substr(0, 40))); }

/// Why the word is no coordinate; empty if it is one.
inline std::string coordinate_trouble(std::string_view word) {
  const auto x = parse_decimal(word);
  if (!x) return fmt::format("{} is no decimal number", quoted(word));
  return is_finite(*x) ? "" : fmt::format("the coordinate {} is not finite", quoted(word));
}

}  // namespace plumbline
