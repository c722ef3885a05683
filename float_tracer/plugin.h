// Tracers from shared libraries: whoever implements plumbline_tracer.h is under test like the tracers of this build.
//
// No code of the library ever runs in this process: it is loaded in child processes only (see isolated.h), where it
// may abort, hang or print. What it says is checked, not believed: a batch of which it answers fewer or more rays
// than asked, writes beyond the answers, or leaves one unset, is Outcome::fault, all of it; so is an answer with an
// unknown outcome or a triangle that isn't there; an impossible `asked` is not used. Each is a breach in
// PreparedBag::conduct. The mode of the bag is not read: every triangle counts as a surface.
#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "float_tracer/tracer.h"

namespace plumbline {

/// Whether the name is that of a library's file: it holds a '/' or ends in .so.
bool names_plugin(std::string_view name);

/// Whether load_plugin made it: its source is the library's path.
inline bool is_plugin(const TracerInfo& info) {
  return info.isolation == Isolation::process && names_plugin(info.source) && info.package == info.source;
}

/// Throws InputError that names the file, the place and the fix: not there, no library, not of this interface or
/// version, a function missing, a description without sense, death while it is loaded or describes itself. `timeout`
/// is in seconds, for that and as in IsolationLimits. Throws std::system_error where there can be no process.
std::unique_ptr<Tracer> load_plugin(const std::string& path, double timeout = 10);

}  // namespace plumbline
