// std::from_chars of binary64, also with a standard library that has it for integers alone, such as libc++ 19.
#pragma once
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string>
#include <string_view>

namespace plumbline {

/// The same by strtod, of text that begins with a digit or a point. What is too large or too small is no error: it
/// is infinite, or the nearest there is. Two limits: the locale has to be "C", which no program of ours leaves; and
/// glibc 2.36 rounds rare subnormal hexfloats wrong, of those with more digits than binary64 holds.
inline std::from_chars_result from_chars_by_strtod(const char* first, const char* last, double& x,
                                                   std::chars_format format = std::chars_format::general) {
  const std::string_view prefix = format == std::chars_format::hex ? "0x" : "";
  std::string text = std::string(prefix).append(first, last);
  if (prefix.empty()) text.resize(std::min(text.find_first_of("xX"), text.size()));  // strtod would read a hexfloat
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const auto used = static_cast<std::size_t>(end - text.c_str());
  if (used <= prefix.size()) return {first, std::errc::invalid_argument};  // of "0x" alone, strtod takes the 0
  x = value;
  return {first + (used - prefix.size()), std::errc{}};
}

/// A template, so that what std lacks is asked for before it is called.
template <class Real>
std::from_chars_result from_chars(const char* first, const char* last, Real& x,
                                  std::chars_format format = std::chars_format::general) {
  if constexpr (requires { std::from_chars(first, last, x, format); }) {
    return std::from_chars(first, last, x, format);
  } else {
    return from_chars_by_strtod(first, last, x, format);
  }
}

}  // namespace plumbline
