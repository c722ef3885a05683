// Commands for people to paste.
#pragma once
#include <string>
#include <string_view>

namespace plumbline {

/// One word for a POSIX shell: as it is, or quoted.
std::string shell_word(std::string_view text);

}  // namespace plumbline
