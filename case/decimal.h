// Exact decimals, as people write them: "1.5", "-.25", "1e-3". A step of 0.05 is five hundredths here, not the double
// nearest to it, so that forty of them are exactly 2.
#pragma once
#include <cstdint>
#include <string_view>

namespace plumbline {

/// digits * 10^exponent. Made by parse_decimal without trailing zeros; 0 is {0, 0}.
struct Decimal {
  std::int64_t digits = 0;
  int exponent = 0;
  friend bool operator==(const Decimal&, const Decimal&) = default;
};

/// `what` names the option in errors. Throws InputError if `text` is no decimal number, has more than 18 significant
/// digits, or is neither 0 nor of a magnitude within [1e-300, 1e300].
Decimal parse_decimal(std::string_view text, std::string_view what);

/// The double nearest to the value, ties to even.
double to_double(const Decimal& value);

/// The value as a multiple of 10^exponent, where exponent <= value.exponent. Throws InputError, with `what`, if the
/// multiple has more than 18 digits.
std::int64_t in_units(const Decimal& value, int exponent, std::string_view what);

}  // namespace plumbline
