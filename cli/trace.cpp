#include "cli/verb.h"

namespace plumbline {

void add_trace(CLI::App&) {}

}  // namespace plumbline
