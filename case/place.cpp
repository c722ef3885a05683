#include "case/place.h"

#include <fmt/format.h>

#include "case/input_error.h"
#include "case/printable.h"

namespace plumbline {

void fail(const Place& place, std::string_view message) {
  throw InputError(printable(fmt::format("{}:{}:{}: {}", place.file, place.line, place.column, message)));
}

}  // namespace plumbline
