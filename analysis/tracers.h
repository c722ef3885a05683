// Every tracer of this build: the floating-point ones and the control tracer `exact`, which is the oracle itself. And
// the foreign ones that somebody names: a shared library by its path, a program by pipe:COMMAND.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// Those of this build in table order; `exact` is the last.
const std::vector<std::unique_ptr<Tracer>>& all_tracers();

struct AbsentTracer {
  std::string name, package;  ///< none for those written here
  std::string needs;          ///< what to do to have it
};

/// Those that this build hasn't for lack of their library, or for this processor can't run, in table order.
const std::vector<AbsentTracer>& absent_tracers();

/// Null if there is none of that name.
const AbsentTracer* absent_tracer_named(std::string_view name);

/// Whom a verb asks that is not told: the textbook kernels as written, BRL-CAD's rules, Embree and `exact`.
std::vector<const Tracer*> standard_tracers();

/// Null if neither this build has one of that name, nor a foreign one found so far calls itself so.
const Tracer* tracer_named(std::string_view name);

/// What to tell of a name that this build has not: what it needs, "did you mean 'exact'?", or the names
/// that it has.
std::string suggest_tracer(std::string_view name);

/// What --tracer has to say for this one of those: its name, or what a foreign one was asked for.
std::string asked_for(const Tracer& tracer);

struct ForeignOptions {
  double timeout = 10;  ///< seconds that it may take for a batch of cases
};

/// What --tracer means: the name of one of this build; pipe:COMMAND, pipe32:COMMAND, or either with brackets before
/// the colon, a program (float_tracer/pipe_tracer.h); a name with a '/' or ending in .so, a library
/// (float_tracer/plugin.h). The last two are made when first asked for, and kept. Throws InputError: with that
/// suggestion; where a foreign tracer can't be had; where it calls itself as another does. Not thread-safe.
const Tracer& find_tracer(std::string_view name, const ForeignOptions& options = {});

/// By their names, of which "all" stands for all of this build; standard_tracers() for none. Throws as find_tracer.
std::vector<const Tracer*> find_tracers(const std::vector<std::string>& names, const ForeignOptions& options = {});

}  // namespace plumbline
