#include "cli/verb.h"

namespace plumbline {

void add_sweep(CLI::App&) {}

}  // namespace plumbline
