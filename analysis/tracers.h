// Every tracer of this build: the floating-point ones and the control tracer `exact`, which is the oracle itself.
#pragma once
#include <memory>
#include <string_view>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// In table order; `exact` is the last.
const std::vector<std::unique_ptr<Tracer>>& all_tracers();

/// Throws InputError that lists the names there are.
const Tracer& find_tracer(std::string_view name);

}  // namespace plumbline
