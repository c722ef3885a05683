// Numbers as text, both ways, exactly: what is written reads back with the same bits, and what is read is the binary64
// number nearest to the text (ties to even) whatever the locale. No allocation in reading.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace plumbline {

/// A decimal (12, -0.5, .5, 1e-3), a hexfloat (0x1.8p+1, the exponent may be left out), inf, -inf or nan; nothing else
/// and nothing around it: no blanks, no '+' in front. Beyond the range of binary64 a number is infinite, and one
/// nearer to zero than to the least subnormal is a zero, signs kept, by IEEE 754. No value if the text is none of
/// these.
std::optional<double> parse_real(std::string_view text);

/// As printf's %a writes: 0x1.8p+1, -0x0p+0, 0x0.0000000000001p-1022, inf, -inf, nan. To be appended to `out`.
void append_hexfloat(std::string& out, double x);
std::string hexfloat(double x);

/// The shortest decimal that reads back as x: 0.1, -0, 1e+22, inf, -inf, nan. To be appended to `out`.
void append_shortest_decimal(std::string& out, double x);
std::string shortest_decimal(double x);

}  // namespace plumbline
