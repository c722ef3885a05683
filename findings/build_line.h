// The build in which something was found, as one line.
#pragma once
#include <string>

#include "float_tracer/tracer.h"

namespace plumbline {

/// "plumbline 0.1.0, clang 19.1.4, Release", and the package that the tracer comes from, with its version.
std::string build_line(const TracerInfo& tracer);

/// The same without a tracer: for answers that were given to us.
std::string build_line();

}  // namespace plumbline
