#include "cli/verb.h"

namespace plumbline {

void add_classify(CLI::App&) {}

}  // namespace plumbline
