#include "cli/verb.h"

namespace plumbline {

void add_tracers(CLI::App&) {}

}  // namespace plumbline
