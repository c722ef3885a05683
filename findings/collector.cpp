#include "findings/collector.h"

#include <algorithm>

namespace plumbline {

Collector::Collector(const std::string& store, std::string source)
    : teller_(store, Open::create), source_(std::move(source)) {}

void Collector::count(const std::string& tracer, std::uint64_t answers) { searches_[tracer].executions += answers; }

void Collector::add(const FoundFinding& finding) {
  SearchRow& search = searches_[finding.tracer];
  const double ulps = finding.found.ulps;
  if (finding.conditioning == Conditioning::nominal)
    search.worst_nominal_ulps = std::max(search.worst_nominal_ulps, ulps);
  const auto [told, is_new] = told_.try_emplace({finding.tracer, finding.signature}, ulps);
  if (!is_new && !(ulps > told->second && ulps >= 2 * told->second)) return;
  teller_.tell(finding);
  told->second = ulps;
  search.signatures += is_new;
}

void Collector::finish() {
  for (auto& [tracer, search] : searches_) {
    search.tracer = tracer;
    search.source = source_;
    teller_.tell(search);
  }
  teller_.finish();
}

}  // namespace plumbline
