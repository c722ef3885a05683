// The libraries under test, those that this build didn't find included.
#pragma once
#include <memory>
#include <string_view>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

struct Adapter {
  std::string_view package;               ///< Debian's
  std::string_view needs;                 ///< what to do where it was not found
  std::vector<std::string_view> tracers;  ///< names, in the order of `make`
  std::vector<std::unique_ptr<Tracer>> (*make)();  ///< null where the package was not found
};

/// In the order in which tables show them.
const std::vector<Adapter>& adapters();

}  // namespace plumbline
