// Cases as text for people and for version control: one keyed line each, numbers as hexfloats. corpus/README.md
// describes the format. Any order of lines is read, one fixed order is written; what is written reads back equal, bit
// for bit.
//
// Reading throws InputError "file:line:column: what is wrong; the fix": an unknown or repeated key, a repeated id, a missing
// triangle or ray, no number where one belongs, a NaN, a value that is not binary32 in a case that claims to be, a plate
// without thickness, a thickness without plate. A byte order mark is skipped.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.h"

namespace plumbline {

/// "-" reads standard input.
std::vector<Case> read_cases(const std::string& path);

struct PlacedCase {
  std::size_t line = 0;  ///< of its line `case`, from 1
  Case what;
};

/// The same, for those who tell where a case is.
std::vector<PlacedCase> read_placed_cases(const std::string& path);

/// `name` stands for the file in messages.
std::vector<Case> parse_cases(std::string_view text, std::string_view name);

/// Throws InputError if the text would not read back equal: an id that is not one word, a newline in the provenance, a
/// NaN, parts of a plate in what is none.
std::string to_text(const Case& what);

}  // namespace plumbline
