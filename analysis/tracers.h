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

/// Whom a verb asks that is not told: the textbook kernels as written, BRL-CAD's rules, Embree and `exact`.
std::vector<const Tracer*> standard_tracers();

/// By their names, of which "all" stands for all; standard_tracers() for none. Throws as find_tracer.
std::vector<const Tracer*> find_tracers(const std::vector<std::string>& names);

/// Null if this build has none of that name.
const Tracer* tracer_named(std::string_view name);

/// What to tell of a name that this build has not: the package that it needs, "did you mean 'exact'?", or the names
/// that it has.
std::string suggest_tracer(std::string_view name);

/// Throws InputError with that suggestion.
const Tracer& find_tracer(std::string_view name);

}  // namespace plumbline
