#include "case/contract_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "case/enum_names.h"
#include "case/finite.h"
#include "case/input_error.h"
#include "case/nearest_name.h"
#include "case/real_text.h"

namespace plumbline {
namespace {

constexpr std::string_view keys[] = {"edges",      "range",   "t_min",          "t_max",         "coplanar",
                                     "degenerate", "culling", "slack_absolute", "slack_relative"};

template <class Enum, std::size_t N>
Enum chosen(const std::array<std::string_view, N>& names, std::string_view key, std::string_view word) {
  if (const auto value = from_name<Enum>(names, word)) return *value;
  throw InputError(fmt::format("{} can't be '{}'; {}", key, word, suggest(word, names)));
}

double slack(std::string_view key, std::string_view word) {
  const auto x = parse_real(word);
  if (x && is_finite(*x) && *x >= 0) return *x;
  throw InputError(fmt::format("{} can't be '{}'; give a finite number that is not negative", key, word));
}

void change(Contract& c, std::string_view key, std::string_view word) {
  if (key == "edges") {
    c.edges = chosen<EdgeRule>(edge_rule_names, key, word);
  } else if (key == "range") {
    c.range = chosen<RangeRule>(range_rule_names, key, word);
  } else if (key == "t_min") {
    c.t_min = chosen<EndRule>(end_rule_names, key, word);
  } else if (key == "t_max") {
    c.t_max = chosen<EndRule>(end_rule_names, key, word);
  } else if (key == "coplanar") {
    c.coplanar = chosen<TouchRule>(touch_rule_names, key, word);
  } else if (key == "degenerate") {
    c.degenerate = chosen<TouchRule>(touch_rule_names, key, word);
  } else if (key == "culling") {
    c.culling = chosen<Culling>(culling_names, key, word);
  } else if (key == "slack_absolute") {
    c.slack_absolute = slack(key, word);
  } else if (key == "slack_relative") {
    c.slack_relative = slack(key, word);
  } else {
    throw InputError(fmt::format("a contract has no '{}'; {}", key, suggest(key, keys)));
  }
}

}  // namespace

Contract changed(Contract contract, std::string_view text) {
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find(','));
    text.remove_prefix(std::min(part.size() + 1, text.size()));
    const std::size_t equals = part.find('=');
    if (equals == part.npos)
      throw InputError(fmt::format("'{}' says nothing of a contract; write key=word, such as edges=open", part));
    change(contract, part.substr(0, equals), part.substr(equals + 1));
  }
  return contract;
}

}  // namespace plumbline
