#include "case/place.h"

#include <fmt/format.h>

#include "case/input_error.h"

namespace plumbline {

void fail(const Place& place, std::string_view message) {
  throw InputError(fmt::format("{}:{}:{}: {}", place.file, place.line, place.column, message));
}

}  // namespace plumbline
