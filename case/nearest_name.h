// "Did you mean ...?": the name that a misspelt word was probably meant to be.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace plumbline {

/// The end of an error message about `word`: "did you mean 'triangle'?" when a name is close (two edits, or one in a
/// short word; an edit inserts, removes or replaces a letter or swaps two neighbours), else "known: a, b, c".
std::string suggest(std::string_view word, std::span<const std::string_view> names);

}  // namespace plumbline
