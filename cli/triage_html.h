// plumbline triage html: findings as static pages for a browser.
#pragma once
#include <CLI/CLI.hpp>

namespace plumbline {

/// Adds the subcommand `html` to the verb `triage`.
void add_triage_html(CLI::App& triage);

}  // namespace plumbline
