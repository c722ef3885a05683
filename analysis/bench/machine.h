// What a benchmark ran on, as text for people.
#pragma once
#include <string>

namespace plumbline {

/// "AMD EPYC 7R13 Processor"
std::string processor();

/// "clang 19.1.7, optimised"
std::string compiler();

}  // namespace plumbline
