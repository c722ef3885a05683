// The subcommands of `plumbline triage`, one a file. Each works on a store of findings, the positional DB.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "findings/finding_row.h"

namespace plumbline {

void add_triage_list(CLI::App& triage);  ///< which is also what `triage` alone does
void add_triage_show(CLI::App& triage);
void add_triage_set(CLI::App& triage);
void add_triage_retest(CLI::App& triage);
void add_triage_rebuild(CLI::App& triage);
void add_triage_collect(CLI::App& triage);
void add_triage_html(CLI::App& triage);

/// The positional DB.
CLI::Option* add_store(CLI::App& app, std::string& path);

/// "open", "dup of 3"
std::string status_text(const FindingRow& row);

/// A whole number from 1; throws InputError.
std::int64_t finding_id(const std::string& word);

/// Fit for a line of a table: printable, and cut where it is longer than that.
std::string cell(std::string_view text, std::size_t most = 40);

}  // namespace plumbline
