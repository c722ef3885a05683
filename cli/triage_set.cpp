#include <fmt/format.h>

#include <memory>

#include "case/input_error.h"
#include "case/printable.h"
#include "cli/triage.h"
#include "findings/store.h"

namespace plumbline {
namespace {

struct Options {
  std::string store;
  std::vector<std::string> words;  // the IDs, and what they are set to
};

struct Wanted {
  FindingStatus status = FindingStatus::open;
  std::int64_t duplicate_of = 0;
};

Wanted wanted(const std::string& word) {
  constexpr std::string_view duplicate = "dup-of:";
  if (word.starts_with(duplicate)) return {FindingStatus::duplicate, finding_id(word.substr(duplicate.size()))};
  for (const FindingStatus status :
       {FindingStatus::open, FindingStatus::fixed, FindingStatus::invalid, FindingStatus::wontfix})
    if (word == name(status)) return {status, 0};
  throw InputError(fmt::format("'{}' is no status; write open, fixed, dup-of:ID, invalid or wontfix behind the IDs",
                               printable(word)));
}

void run(const Options& options) {
  if (options.words.size() < 2)
    throw InputError("set which findings to what? Give IDs and a status: 'triage set found.db 2 3 invalid'");
  const auto [status, duplicate_of] = wanted(options.words.back());
  std::vector<std::int64_t> ids;
  for (std::size_t i = 0; i + 1 < options.words.size(); ++i) ids.push_back(finding_id(options.words[i]));
  FindingStore store(options.store);
  for (const std::int64_t id : ids)  // all or none
    if (!store.row(id))
      throw InputError(fmt::format("{0}: no finding {1}; 'plumbline triage {0}' lists them", options.store, id));
  for (const std::int64_t id : ids) store.set_status(id, status, duplicate_of, "person");
}

}  // namespace

void add_triage_set(CLI::App& triage) {
  CLI::App* verb = triage.add_subcommand("set", "Settle findings, or open them again");
  auto options = std::make_shared<Options>();
  add_store(*verb, options->store)->required();
  verb->add_option("ID... STATUS", options->words,
                   "IDs as triage lists them, then what they are:\n"
                   "open, fixed, dup-of:ID, invalid or wontfix")
      ->required();
  verb->footer(
      "  fixed      the tracer is right now; found again, it is open again\n"
      "  dup-of:ID  the same fault as that finding\n"
      "  invalid    no fault: the contract is not what plumbline takes it for\n"
      "  wontfix    a fault that stays\n"
      "\nExamples:\n"
      "  plumbline triage set found.db 3 fixed\n"
      "  plumbline triage set found.db 4 5 9 dup-of:1");
  verb->callback([options] { run(*options); });
}

}  // namespace plumbline
