#include "fuzz/alarm.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "case/case_text.h"
#include "fuzz/findings_folder.h"

namespace plumbline {
namespace {

constexpr std::size_t kinds = finding_kind_names.size(), elements = element_names.size(), classes = kinds * elements * 2;

std::size_t class_of(const Signature& s) {
  return (static_cast<std::size_t>(s.kind) * elements + static_cast<std::size_t>(s.element)) * 2 + (s.conditioning == Conditioning::nominal);
}

std::string token(std::size_t index) {
  std::string text = fmt::format("{}_{}_{}", finding_kind_names[index / 2 / elements], element_names[index / 2 % elements],
                                 index % 2 != 0 ? "nominal" : "ill_conditioned");
  std::ranges::replace(text, '-', '_');
  return text;
}

// One function for each class, on top of the stack when it aborts.
template <std::size_t Class>
[[gnu::noinline]] void fail(const std::string& text) {
  const std::string name = token(Class);
  fmt::print(stderr, "plumbline: Assertion `{}' failed\nDEDUP_TOKEN: {}\n{}", name, name, text);
  std::fflush(stderr);
  std::abort();
}

constexpr auto failures = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array{&fail<I>...};
}(std::make_index_sequence<classes>{});

}  // namespace

void Baseline::add(const Finding& finding) {
  double& worst = worst_[class_of(finding.signature)];
  worst = std::max(worst, finding.ulps);
}

bool Baseline::exceeded_by(const Finding& finding) const {
  const auto known = worst_.find(class_of(finding.signature));
  return known == worst_.end() || (finding.ulps > known->second && finding.ulps >= 2 * known->second);
}

void raise_alarm(const Finding& finding, const CampaignPlan& plan) {
  failures[class_of(finding.signature)](to_text(to_case(finding, plan)));
  std::abort();  // not reached; keeps the call above from being a jump, and this function on the stack
}

}  // namespace plumbline
