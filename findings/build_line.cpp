#include "findings/build_line.h"

#include <fmt/format.h>

namespace plumbline {
namespace {

#ifdef __clang__
constexpr const char* compiler = "clang " __clang_version__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

}  // namespace

std::string build_line() {
  std::string text(compiler);
  text.erase(text.find_last_not_of(' ') + 1);
  return fmt::format("plumbline {}, {}, {}", PLUMBLINE_VERSION, text, PLUMBLINE_BUILD_TYPE);
}

std::string build_line(const TracerInfo& tracer) {
  return tracer.package.empty() ? build_line() : fmt::format("{}; {}", build_line(), tracer.package);
}

}  // namespace plumbline
