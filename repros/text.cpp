#include "repros/text.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/float_bits.h"
#include "case/real_text.h"

namespace plumbline {

std::string fill(std::string_view text, std::initializer_list<TemplatePlace> places) {
  std::string filled;
  for (std::size_t at = 0; at < text.size();) {
    const auto* place = std::ranges::find_if(places, [&](const TemplatePlace& p) {
      return text[at] == '@' && text.substr(at + 1).starts_with(p.name) &&
             text.substr(at + 1 + p.name.size()).starts_with('@');
    });
    if (place == places.end()) {
      filled += text[at++];
    } else {
      filled += place->text;
      at += place->name.size() + 2;
    }
  }
  return filled;
}

std::string harmless(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool plain = c >= ' ' && c <= '~' && c != '\\' && c != '{' && c != '}';
    out += plain ? std::string(1, c) : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return out;
}

std::string c_string(std::string_view text) {
  std::string literal = "\"";
  for (const char c : text) {
    const bool plain = c >= ' ' && c <= '~' && c != '"' && c != '\\' && c != '?';  // '?': no trigraphs
    literal += plain ? std::string(1, c) : fmt::format("\\{:03o}", static_cast<unsigned char>(c));
  }
  return literal + '"';
}

std::string commented(std::string_view lines, std::string_view leader) {
  std::string out;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    std::string line = std::string(leader) + std::string(lines.substr(0, end));
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  return out;
}

std::string c_number(double x, Precision precision) {
  if (!is_finite(x)) return x < 0 ? "-INFINITY" : "INFINITY";
  return hexfloat(x) + (precision == Precision::binary32 ? "f" : "");
}

std::string c_numbers(const Vec3& v, Precision precision) {
  return c_number(v.x, precision) + ", " + c_number(v.y, precision) + ", " + c_number(v.z, precision);
}

std::string decimals(const Vec3& v, std::string_view separator) {
  return fmt::format("{}{}{}{}{}", shortest_decimal(v.x), separator, shortest_decimal(v.y), separator,
                     shortest_decimal(v.z));
}

}  // namespace plumbline
