#include "cli/number_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>

namespace plumbline {

CLI::Validator no_option_among(std::string_view what) {
  return {[what](const std::string& word) {
            return word.starts_with("--") ? fmt::format("{}, before '{}'", what, word) : "";
          },
          ""};
}

CLI::Validator whole_number() {
  return {[](const std::string& word) {
            std::uint64_t number = 0;
            const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
            const bool good = error == std::errc() && end == word.data() + word.size();
            return good ? "" : fmt::format("'{}' is no whole number below 2^64; write digits alone, like 1000", word);
          },
          ""};
}

}  // namespace plumbline
