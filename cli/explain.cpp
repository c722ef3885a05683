#include "cli/verb.h"

namespace plumbline {

void add_explain(CLI::App&) {}

}  // namespace plumbline
