// Programs as tracers: `pipe:CMD`, or `pipe32:CMD` for one that reads binary32. A case is a line of JSON on the
// program's standard input, with the keys of `plumbline classify --help`; its answer is a line on standard output
// with the case's `id` and `hit`, and t, u, v, triangle_index if it likes. The program is kept running, one copy for
// each thread that asks, and is given several lines before it is asked for an answer; the answers may come in any
// order, but have to be flushed. Its standard error passes through. It promises what Contract promises by default,
// but for what stands in brackets: `pipe[edges=open,slack_relative=1e-6]:CMD`, as case/contract_text.h reads it.
//
// What comes is checked, not believed: malformed JSON, an id that wasn't asked, two answers to a case, none in time,
// and the program's death are told on standard error, the program is started anew, and what it hasn't answered then
// is asked one case at a time, so that the case to blame alone is Outcome::fault. After many such in a row it is
// given up.
#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "float_tracer/tracer.h"

namespace plumbline {

/// Whether the name begins with pipe: or pipe32:, or one of these with brackets before the colon.
inline bool names_pipe(std::string_view name) {
  for (const std::string_view kind : {"pipe:", "pipe[", "pipe32:", "pipe32["})
    if (name.starts_with(kind)) return true;
  return false;
}

/// Starts the program and asks it an easy case. Throws InputError, with the line to try, if that isn't answered; and
/// for brackets that can't be read.
/// `timeout` is in seconds, for a batch. SIGPIPE has to be ignored.
std::unique_ptr<Tracer> pipe_tracer(const std::string& name, double timeout);

}  // namespace plumbline
