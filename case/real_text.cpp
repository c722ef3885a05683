#include "case/real_text.h"

#include <algorithm>
#include <limits>

#include "case/float_bits.h"
#include "case/from_chars.h"

namespace plumbline {
namespace {

// Whether a number that binary64 can't hold is too large for it; otherwise it is too small. The sign of the exponent of
// its leading digit decides, for it is beyond 300 decimally and 1000 in binary.
bool is_huge(std::string_view digits, std::chars_format format) {
  const bool hex = format == std::chars_format::hex;
  const auto exponent_at = digits.find_first_of(hex ? "pP" : "eE");
  const std::string_view significand = digits.substr(0, exponent_at);
  const auto point = std::min(significand.find('.'), significand.size());
  const auto leading = significand.find_first_not_of("0.");
  const auto places = static_cast<long long>(point) - static_cast<long long>(leading);  // > 0 before the point
  if (exponent_at == std::string_view::npos) return places > 0;

  std::string_view exponent = digits.substr(exponent_at + 1);
  const bool negative = exponent.starts_with('-');
  if (negative || exponent.starts_with('+')) exponent.remove_prefix(1);
  long long value = 0;
  if (std::from_chars(exponent.data(), exponent.data() + exponent.size(), value).ec != std::errc{}) return !negative;
  return (negative ? -value : value) + (hex ? 4 : 1) * places > 0;
}

}  // namespace

std::optional<double> parse_real(std::string_view text) {
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  std::string_view digits = text;
  const bool negative = digits.starts_with('-');
  if (negative) digits.remove_prefix(1);
  const auto with_sign = [negative](double x) { return negative ? -x : x; };
  constexpr double inf = std::numeric_limits<double>::infinity();
  if (digits == "inf") return with_sign(inf);

  auto format = std::chars_format::general;
  if (digits.starts_with("0x") || digits.starts_with("0X")) {
    format = std::chars_format::hex;
    digits.remove_prefix(2);
  }
  // from_chars would also take another minus, "infinity" and "nan(0)".
  const bool hex = format == std::chars_format::hex;
  if (digits.find_first_of(hex ? ".0123456789abcdefABCDEF" : ".0123456789") != 0) return std::nullopt;
  double x = 0;
  const auto [end, error] = from_chars(digits.data(), digits.data() + digits.size(), x, format);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) x = is_huge(digits, format) ? inf : 0;
  return with_sign(x);
}

void append_hexfloat(std::string& out, double x) {
  if (!is_finite(x)) return append_shortest_decimal(out, x);
  char digits[32];  // to_chars leaves out the "0x", which belongs behind the sign
  const double magnitude = is_negative(x) ? -x : x;
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, magnitude, std::chars_format::hex);
  out += is_negative(x) ? "-0x" : "0x";
  out.append(digits, end);
}

std::string hexfloat(double x) {
  std::string text;
  append_hexfloat(text, x);
  return text;
}

void append_shortest_decimal(std::string& out, double x) {
  if (is_nan(x)) {  // to_chars would write the sign of a NaN
    out += "nan";
    return;
  }
  char digits[32];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, x);
  out.append(digits, end);
}

std::string shortest_decimal(double x) {
  std::string text;
  append_shortest_decimal(text, x);
  return text;
}

}  // namespace plumbline
