#include "cli/verb.h"

namespace plumbline {

void add_replay(CLI::App&, bool&) {}

}  // namespace plumbline
