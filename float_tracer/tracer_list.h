// The floating-point tracers that this build holds.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// In the order in which tables show them: textbook kernels, BRL-CAD's rules, real libraries.
std::vector<std::unique_ptr<Tracer>> float_tracers();

}  // namespace plumbline
