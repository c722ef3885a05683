// Text that becomes part of programs: templates with named places, comments that nothing can break out of, numbers
// without loss. Private to repros/.
#pragma once
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "case/case.h"

namespace plumbline {

struct TemplatePlace {
  std::string_view name;  ///< in capitals
  std::string text;
};

/// Each @NAME@ of the template replaced, once: what is put in is not searched again.
std::string fill(std::string_view text, std::initializer_list<TemplatePlace> places);

/// Text of somebody else's on one line of a comment, in whatever language: all but printable ASCII, backslashes and
/// braces (which Tcl counts in comments as well) become \xNN.
std::string harmless(std::string_view text);

/// Each line behind the leader, "// " say.
std::string commented(std::string_view lines, std::string_view leader);

/// A string literal of C: all but printable ASCII as octal escapes.
std::string c_string(std::string_view text);

/// "0x1p+0f, 0x0p+0f, -0x1p-1f": binary32 with a suffix. INFINITY where it is infinite.
std::string c_number(double x, Precision precision);
std::string c_numbers(const Vec3& v, Precision precision);

/// "1, 0, -0.5", the shortest that read back as the same doubles.
std::string decimals(const Vec3& v, std::string_view separator = ", ");

}  // namespace plumbline
