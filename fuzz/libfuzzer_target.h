// What the parts of a libFuzzer program share.
#pragma once
#include "fuzz/worker.h"

namespace plumbline {

/// The one search of the process; there once libFuzzer has initialized the target.
Worker& libfuzzer_worker();

/// The tracer that is really run for this one: itself, or a build of it that is instrumented for coverage.
const Tracer& as_traced(const Tracer& tracer);

}  // namespace plumbline
