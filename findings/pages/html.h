// Text put into pages so that it stays text, whatever it holds: names are their users', and may be hostile.
#pragma once
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace plumbline {

/// For the contents of elements and for attributes in quotes. What HTML has no character for, control characters,
/// become U+FFFD.
std::string escaped(std::string_view text);

/// JSON for the contents of a script element: no '<' is left in it that could end the element.
std::string json_in_html(std::string json);

/// A table that scrolls by itself; head and rows are HTML.
std::string table(std::string_view label, std::string_view head, std::string_view rows,
                  std::string_view style = "scroll");
std::string number_cell(std::string_view text);

/// The template with each {{name}} replaced by its value, once: values aren't looked at again. Every name has to be
/// there.
std::string filled(std::string_view page,
                   std::initializer_list<std::pair<std::string_view, std::string_view>> values);

}  // namespace plumbline
