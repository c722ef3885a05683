// Every tracer of this build: the floating-point ones and the control tracer `exact`, which is the oracle itself.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// In table order; `exact` is the last.
const std::vector<std::unique_ptr<Tracer>>& all_tracers();

/// Null if this build has none of that name.
const Tracer* tracer_named(std::string_view name);

/// What to tell of a name that this build has not: "did you mean 'exact'?", or the names that it has.
std::string suggest_tracer(std::string_view name);

/// Throws InputError with that suggestion.
const Tracer& find_tracer(std::string_view name);

}  // namespace plumbline
