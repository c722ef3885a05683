// The files beside this one that pages are made of, as they are: compiled in by cmake/EmbedText.cmake.
#pragma once
#include <string_view>

namespace plumbline {

extern const std::string_view list_html, finding_html, page_css, list_js, finding_js;

}  // namespace plumbline
