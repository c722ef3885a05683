#include "case/nearest_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace plumbline {
namespace {

// The number of edits between two words (Damerau-Levenshtein, restricted to one edit per place).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string suggest(std::string_view word, std::span<const std::string_view> names) {
  constexpr std::size_t longest_name = 64;
  if (word.size() <= longest_name) {
    const std::size_t reach = word.size() < 4 ? 1 : 2;
    const auto distance = [&](std::string_view name) { return edit_distance(word, name); };
    const auto nearest = std::ranges::min_element(names, {}, distance);
    if (nearest != names.end() && distance(*nearest) <= reach) return fmt::format("did you mean '{}'?", *nearest);
  }
  return fmt::format("known: {}", fmt::join(names, ", "));
}

}  // namespace plumbline
