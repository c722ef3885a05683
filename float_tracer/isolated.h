// Runs a tracer in child processes, so that it may abort, hang, exit or print without harm to us.
//
// What the caller sees is the tracer itself, except that
// - a ray that it dies of is Outcome::fault, and no other answer is lost or changed. If it dies of the bag, every ray
// is
//   a fault. What a death is: a signal, an exit, an exception, or no answer within the time limit.
// - PreparedBag::conduct counts these rays, by the cause.
// - the bag is built when it is first shot at, so that `prepare` never fails of the tracer.
//
// A batch is traced in one go. If the child dies, a fresh one traces it again, ray by ray; if that dies as well,
// another one begins with the ray at which it did, and only a ray of which a fresh child dies is a fault: what
// earlier rays have destroyed is not blamed on it. So a killing ray costs two children, each with the bag built anew;
// one that hangs, also two time limits, and the batch's.
//
// Children are kept: a tracer has as many as there are threads tracing with it at the same time, each with the bag
// that it was given last. They come from a fork server (see fork_server.h), which is started by the first `prepare`.
// Rays and answers are in memory shared with the child; a byte on a socket says that there is something to do, or
// that it's done. The child works under the caller's floating-point controls, and says whether it found them changed.
#pragma once
#include <chrono>
#include <memory>

#include "float_tracer/tracer.h"

namespace plumbline {

struct IsolationLimits {
  std::chrono::milliseconds timeout{10'000};  ///< for a batch of up to 65536 rays, for a single ray, to build a bag
};

/// The tracer may be used and destroyed by any thread, its bags may outlive it. Throws std::system_error, in
/// `prepare`, where there can be no process at all.
std::unique_ptr<Tracer> isolated(std::unique_ptr<Tracer> tracer, IsolationLimits limits = {});

}  // namespace plumbline
