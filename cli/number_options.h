// What options may hold that take numbers.
#pragma once
#include <CLI/CLI.hpp>
#include <string_view>

namespace plumbline {

/// For an option whose variable is an array, so that it takes exactly as many words, whatever they begin with (-.5 and
/// -inf are numbers): none of them is the next option. `what` is told else, such as "3 numbers X Y Z".
CLI::Validator no_option_among(std::string_view what);

/// For an option whose variable is a std::uint64_t.
CLI::Validator whole_number();

}  // namespace plumbline
