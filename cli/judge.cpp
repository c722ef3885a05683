#include "cli/verb.h"

namespace plumbline {

void add_judge(CLI::App&, bool&) {}

}  // namespace plumbline
