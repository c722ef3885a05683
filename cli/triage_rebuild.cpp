#include <fmt/format.h>

#include <memory>

#include "cli/triage.h"
#include "findings/store.h"

namespace plumbline {

void add_triage_rebuild(CLI::App& triage) {
  CLI::App* verb = triage.add_subcommand("rebuild", "Make the database anew from its journal");
  auto path = std::make_shared<std::string>();
  add_store(*verb, *path)->required();
  verb->footer(
      "For a DB that is damaged, or gone. Everything in it comes from DB.ndjson, so the findings and their ids are "
      "the same\n"
      "again. Lines of the journal that are damaged are named, skipped, and stay in the file. What was there as DB "
      "is kept\n"
      "as DB.old.\n"
      "\nExample:\n"
      "  plumbline triage rebuild found.db");
  verb->callback([path] {
    for (const std::string& warning : rebuild(*path)) fmt::print(stderr, "warning: skipped {}\n", warning);
  });
}

}  // namespace plumbline
