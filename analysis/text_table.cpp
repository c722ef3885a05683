#include "analysis/text_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace plumbline {
namespace {

std::vector<std::size_t> widths_of(const TextTable& table) {
  std::vector<std::size_t> widths;
  for (const TextColumn& column : table.columns) widths.push_back(column.title.size());
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  return widths;
}

// What stands before, between and after the cells of a line.
struct Frame {
  std::string_view open, between, close;
};

template <class CellOf>
std::string line(const TextTable& table, const std::vector<std::size_t>& widths, const Frame& frame, CellOf cell_of) {
  std::string text(frame.open);
  for (std::size_t i = 0; i < widths.size(); ++i) {
    if (i > 0) text += frame.between;
    text += fmt::format(fmt::runtime(table.columns[i].number ? "{:>{}}" : "{:<{}}"), cell_of(i), widths[i]);
  }
  text += frame.close;
  text.erase(text.find_last_not_of(' ') + 1);
  return text + '\n';
}

template <class RuleOf>
std::string lines(const TextTable& table, const Frame& frame, RuleOf rule_of) {
  const auto widths = widths_of(table);
  std::string text = line(table, widths, frame, [&](std::size_t i) { return table.columns[i].title; });
  text += line(table, widths, frame, [&](std::size_t i) { return rule_of(table.columns[i], widths[i]); });
  for (const auto& row : table.rows) text += line(table, widths, frame, [&](std::size_t i) { return row[i]; });
  return text;
}

}  // namespace

std::string to_terminal(const TextTable& table) {
  return lines(table, {"", "  ", ""}, [](const TextColumn&, std::size_t width) { return std::string(width, '-'); });
}

std::string to_markdown(const TextTable& table) {
  return lines(table, {"| ", " | ", " |"}, [](const TextColumn& column, std::size_t width) {
    return std::string(width - 1, '-') + (column.number ? ':' : '-');
  });
}

}  // namespace plumbline
