#include "case/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace plumbline {
namespace {

// The length of the UTF-8 character that `text` begins with; 0: it is none. By table 3-7 of the Unicode standard.
std::size_t character(std::string_view text) {
  const auto byte = [text](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto follows = [byte](std::size_t i, unsigned least = 0x80, unsigned most = 0xbf) {
    return byte(i) >= least && byte(i) <= most;
  };
  const unsigned b = byte(0);
  if (b < 0x80) return 1;
  if (b >= 0xc2 && b <= 0xdf) return follows(1) ? 2 : 0;
  if (b >= 0xe0 && b <= 0xef)
    return follows(1, b == 0xe0 ? 0xa0 : 0x80, b == 0xed ? 0x9f : 0xbf) && follows(2) ? 3 : 0;
  if (b >= 0xf0 && b <= 0xf4)
    return follows(1, b == 0xf0 ? 0x90 : 0x80, b == 0xf4 ? 0x8f : 0xbf) && follows(2) && follows(3) ? 4 : 0;
  return 0;
}

// C0, DEL and C1.
bool is_control(std::string_view one) {
  const auto first = static_cast<unsigned char>(one[0]);
  return first < 0x20 || first == 0x7f ||
         (one.size() == 2 && first == 0xc2 && static_cast<unsigned char>(one[1]) < 0xa0);
}

void append_escaped(std::string& out, std::string_view bytes) {
  if (bytes == "\n")
    out += "\\n";
  else if (bytes == "\t")
    out += "\\t";
  else
    for (const char c : bytes) out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
}

bool is_plain(char c) { return c >= ' ' && c < 0x7f; }

template <class Escape>
std::string escaped(std::string_view text, Escape escape) {
  if (std::ranges::all_of(text, is_plain)) return std::string(text);  // nearly always
  std::string out;
  while (!text.empty()) {
    const std::size_t size = character(text);
    const std::string_view one = text.substr(0, size == 0 ? 1 : size);
    if (size == 0 || escape(one))
      append_escaped(out, one);
    else
      out += one;
    text.remove_prefix(one.size());
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) { return escaped(text, is_control); }

std::string valid_utf8(std::string_view text) {
  return escaped(text, [](std::string_view) { return false; });
}

}  // namespace plumbline
