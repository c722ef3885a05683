// JSON that nlohmann's library has parsed, as text again, every number the same double as before.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace plumbline {

/// The library takes -0 for an integer that is 0. Since it takes every other one without a minus for an unsigned one,
/// what is a signed 0 was -0.
inline void restore_minus_zero(nlohmann::json& value) {
  if (value.is_number_integer() && !value.is_number_unsigned() && value.get<std::int64_t>() == 0) value = -0.0;
  if (value.is_structured())
    for (auto& element : value) restore_minus_zero(element);
}

inline std::string text_of(nlohmann::json value) {
  restore_minus_zero(value);
  return value.dump();
}

}  // namespace plumbline
