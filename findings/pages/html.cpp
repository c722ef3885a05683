#include "findings/pages/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace plumbline {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      case '\n':
      case '\t': out += c; break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
          out += "\xef\xbf\xbd";
        else
          out += c;
    }
  }
  return out;
}

std::string json_in_html(std::string json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

std::string table(std::string_view label, std::string_view head, std::string_view rows, std::string_view style) {
  return fmt::format(
      "<div class=\"{}\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table><thead><tr>{}</tr></thead><tbody>{}"
      "</tbody></table></div>",
      style, escaped(label), head, rows);
}

std::string number_cell(std::string_view text) { return fmt::format("<td class=\"n\">{}", escaped(text)); }

std::string filled(std::string_view page,
                   std::initializer_list<std::pair<std::string_view, std::string_view>> values) {
  std::string out;
  for (;;) {
    const auto at = page.find("{{");
    if (at == std::string_view::npos) return out.append(page);
    const auto end = page.find("}}", at);
    const auto name = page.substr(at + 2, end - at - 2);
    const auto* const value = std::ranges::find(values, name, [](const auto& v) { return v.first; });
    if (end == std::string_view::npos || value == values.end())
      throw std::logic_error("a page's template names what there is not: " + std::string(name));
    out.append(page.substr(0, at)).append(value->second);
    page.remove_prefix(end + 2);
  }
}

}  // namespace plumbline
