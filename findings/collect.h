// Findings from files that others wrote: .case files with lines `known`, and what campaigns keep in their folders.
// None is trusted: each is asked for again, of the tracer that it names.
#pragma once
#include <functional>
#include <string>

#include "case/case.h"

namespace plumbline {

/// take(case, tracer) for each finding of a file FILE.case or FILE.ndjson, or of all that a folder has of both. A
/// case without a line `known` is none. Throws InputError: nothing there to read, or no findings.
void for_each_known(const std::string& path,
                    const std::function<void(const Case& what, const std::string& tracer)>& take);

}  // namespace plumbline
