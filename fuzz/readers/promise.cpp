#include "fuzz/readers/promise.h"

#include <cstdio>
#include <cstdlib>

#include "case/printable.h"

namespace plumbline {

void broken(std::string_view what) {
  std::fprintf(stderr, "a reader broke its promise: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

void check_message(const InputError& error) {
  const std::string_view message = error.what();
  if (message.empty()) broken("an error without a message");
  if (printable(message) != message) broken("a message that is not one printable line");
}

}  // namespace plumbline

extern "C" int LLVMFuzzerInitialize(int*, char***) { return 0; }  // no options of ours
