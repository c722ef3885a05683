// The option --findings, of every verb that feeds a store of findings.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace plumbline {

inline void add_findings_option(CLI::App& verb, std::string& path) {
  verb.add_option("--findings", path,
                  "Tell what is found to this store too, for 'plumbline triage'; made where there is none")
      ->type_name("DB");
}

}  // namespace plumbline
