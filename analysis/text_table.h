// A table as text: aligned columns for the terminal, pipes for Markdown.
#pragma once
#include <string>
#include <vector>

namespace plumbline {

struct TextColumn {
  std::string title;
  bool number = false;  ///< set flush right
};

/// Every row has as many cells as there are columns.
struct TextTable {
  std::vector<TextColumn> columns;
  std::vector<std::vector<std::string>> rows;
};

std::string to_terminal(const TextTable& table);
/// GitHub's dialect. Cells hold no '|'.
std::string to_markdown(const TextTable& table);

}  // namespace plumbline
