// What happens to a store: something is found, a search ends, somebody decides. Everything else that a store tells
// follows from these, in their order.
#pragma once
#include <string>
#include <variant>

#include "findings/finding_row.h"

namespace plumbline {

/// A case that a tracer gets wrong.
struct FoundFinding {
  std::string tracer;
  std::string signature;  ///< as to_word has it
  FindingKind kind = FindingKind::false_miss;
  Element element = Element::none;
  Conditioning conditioning = Conditioning::nominal;
  FoundCase found;  ///< id, provenance, expectation and `known` of its case are not kept: they follow
  std::string build;   ///< compiler, flags, versions
  std::string source;  ///< "fuzz: space ray, domain nominal, seed 1"
  std::string seen;    ///< UTC; empty: now
};

/// Findings are named by what stays the same if a line of the journal is damaged, unlike ids.
struct FindingName {
  std::string tracer, signature;
  friend bool operator==(const FindingName&, const FindingName&) = default;
};

struct StatusSet {
  FindingName finding;
  FindingStatus status = FindingStatus::open;
  FindingName duplicate_of;  ///< where status is duplicate
  std::string by;            ///< "person", "retest"
  std::string set;           ///< UTC; empty: now
};

/// A SearchRow is a search that ended; no end: now.
using Event = std::variant<FoundFinding, SearchRow, StatusSet>;

}  // namespace plumbline
