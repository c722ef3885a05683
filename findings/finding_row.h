// What a findings store tells: a row for each signature of each tracer (analysis/signature.h), a row for each search that
// fed it. Plain values, for the terminal, the pages and everything else that shows findings.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/signature.h"
#include "case/case.h"

namespace plumbline {

enum class FindingStatus : unsigned char { open, fixed, duplicate, invalid, wontfix };
inline constexpr std::array<std::string_view, 5> finding_status_names = {"open", "fixed", "dup", "invalid", "wontfix"};
constexpr std::string_view name(FindingStatus s) { return finding_status_names[static_cast<unsigned>(s)]; }

/// A case that the tracer gets wrong in this way.
struct FoundCase {
  double ulps = 0;    ///< how badly (finding_ulps)
  unsigned bits = 0;  ///< significant bits of all its numbers
  Case what;          ///< with provenance, expectation and the line `known`
};

struct FindingRow {
  std::int64_t id = 0;    ///< from 1, in the order of finding; the same after a rebuild
  std::string tracer;     ///< any text: foreign tracers are named by their users
  std::string signature;  ///< as to_word has it
  FindingKind kind = FindingKind::false_miss;
  Element element = Element::none;
  Conditioning conditioning = Conditioning::nominal;
  std::uint64_t count = 0;          ///< findings of this signature that were told to the store
  FoundCase worst, simplest;        ///< of the greatest severity; of the fewest significant bits
  std::vector<std::string> builds;  ///< in which it was seen: compiler, flags, versions, as one line each
  std::string first_seen, last_seen;  ///< UTC, as 2026-11-26T01:30:00Z
  FindingStatus status = FindingStatus::open;
  std::int64_t duplicate_of = 0;  ///< id, where status is duplicate
  bool is_new = false;            ///< first seen since the last search but one ended
};

/// A campaign, a sweep, a run of judge.
struct SearchRow {
  std::string tracer;
  std::string source;  ///< "fuzz: space ray, domain nominal, seed 1", "sweep", "judge"
  std::string ended;   ///< UTC
  std::uint64_t executions = 0;
  double worst_nominal_ulps = 0;  ///< worst nominal severity; 0: no wrong answer
  double least_margin_ulps = 0;   ///< how near to another answer it came, where it was told; else 0
  std::uint64_t signatures = 0;   ///< found in it
};

}  // namespace plumbline
