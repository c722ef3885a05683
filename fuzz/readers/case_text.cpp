// The text of a .case file.
#include "case/case_text.h"

#include <cstddef>
#include <cstdint>

#include "fuzz/readers/promise.h"

namespace plumbline {
namespace {

void run(std::string_view text) {
  std::vector<Case> cases;
  if (refused([&] { cases = parse_cases(text, "case"); })) return;
  for (const Case& read : cases) {
    const std::string written = reread([&] { return to_text(read); });
    const std::vector<Case> again = reread([&] { return parse_cases(written, "written"); });
    if (again.size() != 1 || again.front() != read) broken("a case that reads back as another");
    if (to_text(again.front()) != written)
      broken("a case that is written in two ways");  // which == wouldn't see of -0
  }
}

}  // namespace
}  // namespace plumbline

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plumbline::run({reinterpret_cast<const char*>(data), size});
  return 0;
}
