// What stands in for pipe_tracer.cpp in a build for fuzzing services, which has nothing to read NDJSON with.
#include <fmt/format.h>

#include "case/input_error.h"
#include "float_tracer/pipe_tracer.h"

namespace plumbline {

std::unique_ptr<Tracer> pipe_tracer(const std::string& name, double) {
  throw InputError(fmt::format("{}: this build, for fuzzing services, takes no programs as tracers", name));
}

}  // namespace plumbline
