// Finds an enumerator by its name in a table of names indexed by the enumerator.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace plumbline {

template <class Enum, std::size_t N>
constexpr std::optional<Enum> from_name(const std::array<std::string_view, N>& names, std::string_view text) {
  for (std::size_t i = 0; i < N; ++i)
    if (names[i] == text) return static_cast<Enum>(i);
  return std::nullopt;
}

}  // namespace plumbline
