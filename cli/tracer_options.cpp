#include "cli/tracer_options.h"

namespace plumbline {

void add_tracer_timeout(CLI::App& verb, ForeignOptions& options) {
  verb.add_option("--tracer-timeout", options.timeout, "How long a tracer of yours may take for a batch of cases")
      ->check(CLI::Range(0.001, 86400.0))
      ->type_name("SECONDS")
      ->capture_default_str();
}

}  // namespace plumbline
