// Text of any origin as UTF-8, for formats that hold nothing else.
#pragma once
#include <string>
#include <string_view>

namespace plumbline {

/// The bytes as they are where they are UTF-8; each byte that is none becomes U+FFFD.
std::string as_utf8(std::string_view bytes);

}  // namespace plumbline
