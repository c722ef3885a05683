#include "case/decimal.h"

#include <fmt/format.h>

#include <array>

#include "case/from_chars.h"
#include "case/input_error.h"

namespace plumbline {
namespace {

constexpr std::int64_t max_digits = 999'999'999'999'999'999;
constexpr int max_magnitude = 300;

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

Decimal parse_decimal(std::string_view text, std::string_view what) {
  const auto not_a_number = [&] {
    return InputError(fmt::format("{} '{}': not a decimal number; write it like 1.5 or 1e-3", what, text));
  };
  std::string_view rest = text;
  const bool negative = rest.starts_with('-');
  if (negative || rest.starts_with('+')) rest.remove_prefix(1);

  Decimal value;
  int pending = 0;  // places read but not yet in `digits`: zeros, until a digit follows them
  bool any_digit = false, after_point = false;
  for (; !rest.empty() && (is_digit(rest[0]) || (rest[0] == '.' && !after_point)); rest.remove_prefix(1)) {
    if (rest[0] == '.') {
      after_point = true;
      continue;
    }
    any_digit = true;
    if (after_point) --value.exponent;
    ++pending;
    if (rest[0] == '0') continue;
    for (; pending > 0; --pending) {
      if (value.digits > max_digits / 10)
        throw InputError(fmt::format("{} '{}': more than 18 significant digits; shorten it", what, text));
      value.digits *= 10;
    }
    value.digits += rest[0] - '0';
  }
  if (!any_digit) throw not_a_number();
  if (!rest.empty()) {
    if (rest[0] != 'e' && rest[0] != 'E') throw not_a_number();
    rest.remove_prefix(1);
    if (rest.starts_with('+') && !rest.starts_with("+-")) rest.remove_prefix(1);
    int shift = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), shift);
    if (end != rest.data() + rest.size() || error == std::errc::invalid_argument) throw not_a_number();
    if (error == std::errc::result_out_of_range || shift > 100'000 || shift < -100'000) shift = 100'000;
    value.exponent += shift;
  }
  if (value.digits == 0) return {};
  value.exponent += pending;
  const int magnitude = value.exponent + static_cast<int>(fmt::formatted_size("{}", value.digits)) - 1;
  if (magnitude > max_magnitude || magnitude < -max_magnitude)
    throw InputError(fmt::format("{} '{}': out of range; use a magnitude between 1e-300 and 1e300", what, text));
  if (negative) value.digits = -value.digits;
  return value;
}

double to_double(const Decimal& value) {
  std::array<char, 40> text;
  const auto end = fmt::format_to_n(text.data(), text.size(), "{}e{}", value.digits, value.exponent).out;
  double nearest = 0;
  from_chars(text.data(), end, nearest);
  return nearest;
}

std::int64_t in_units(const Decimal& value, int exponent, std::string_view what) {
  std::int64_t units = value.digits;
  for (int e = value.exponent; e > exponent && units != 0; --e) {
    if (units > max_digits / 10 || units < -max_digits / 10)
      throw InputError(
          fmt::format("{}: {}e{} is more than 18 digits away from the finest digit in use; "
                      "bring box, step and offset closer in size",
                      what, value.digits, value.exponent));
    units *= 10;
  }
  return units;
}

}  // namespace plumbline
