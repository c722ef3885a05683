// Feeds a store from whatever judges many answers: tells the findings that are new or twice as severe as when they were
// last told, as a campaign does, and at the end what was searched.
#pragma once
#include <map>
#include <string>
#include <utility>

#include "findings/event.h"
#include "findings/journal.h"

namespace plumbline {

class Collector {
 public:
  /// `source` is what the searches are called: "sweep".
  Collector(Journal& journal, std::string source) : journal_(journal), source_(std::move(source)) {}

  /// Answers of this tracer that were looked at.
  void count(const std::string& tracer, std::uint64_t answers);
  void add(const FoundFinding& finding);
  /// Tells a search for each tracer.
  void finish();

 private:
  Journal& journal_;
  std::string source_;
  std::map<std::string, SearchRow> searches_;                         // by tracer
  std::map<std::pair<std::string, std::string>, double> told_;        // by tracer and signature: the severity
};

}  // namespace plumbline
