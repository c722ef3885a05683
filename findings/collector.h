// Feeds a store from whatever judges many answers: tells the findings that are new or twice as severe as when they
// were last told, as a campaign does, and at the end what was searched.
#pragma once
#include <map>
#include <string>
#include <utility>

#include "findings/event.h"
#include "findings/teller.h"

namespace plumbline {

class Collector {
 public:
  /// For the store, which is made where there is none. `source` is what the searches are called: "sweep".
  Collector(const std::string& store, std::string source);

  /// Answers of this tracer that were looked at.
  void count(const std::string& tracer, std::uint64_t answers);
  void add(const FoundFinding& finding);
  /// A plainer form of what was added.
  void add_plainer(const FoundFinding& finding) { teller_.tell(finding); }
  /// Tells a search for each tracer. Throws InputError where anything could not be told up to now.
  void finish();

 private:
  Teller teller_;
  std::string source_;
  std::map<std::string, SearchRow> searches_;                   // by tracer
  std::map<std::pair<std::string, std::string>, double> told_;  // by tracer and signature: the severity
};

}  // namespace plumbline
