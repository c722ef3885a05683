// The lines of which explanations are made, and those that all of them have.
#pragma once
#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>

#include "case/answer.h"
#include "case/contract.h"
#include "case/query.h"

namespace plumbline {

inline std::string number(double x) { return fmt::format("{:<24} ({:a})", x, x); }
inline std::string point(const Vec3& v) {
  return fmt::format("{:a} {:a} {:a}   ({}, {}, {})", v.x, v.y, v.z, v.x, v.y, v.z);
}

class Lines {
 public:
  template <class... Args>
  void add(std::string_view label, fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), "{:<10} ", label);
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_ += '\n';
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

inline void add_query(Lines& lines, const Query& query) {
  const Ray& ray = query.ray;
  lines.add("origin", "{}", point(ray.origin));
  lines.add("direction", "{}", point(ray.direction));
  if (query.has_tail()) lines.add("", "+ {}", point(query.direction_tail));
  lines.add("range", "{:a} {:a}   ({}, {})", ray.t_min, ray.t_max, ray.t_min, ray.t_max);
}

inline void add_contract(Lines& lines, const Contract& contract) {
  lines.add("contract", "{} inputs, edges {}, t range {} ({} at its start, {} at its end)", name(contract.precision),
            name(contract.edges), name(contract.range), name(contract.t_min), name(contract.t_max));
}

inline void add_answer(Lines& lines, const Answer& answer) {
  constexpr std::string_view outcomes[] = {"miss", "hit", "fault"};
  lines.add("answer", "{}", outcomes[static_cast<unsigned>(answer.outcome)]);
  if (answer.has_t) lines.add("", "t {}", number(answer.t));
  if (answer.has_uv) lines.add("", "u {}   v {}", number(answer.u), number(answer.v));
  if (answer.has_segment) lines.add("", "in {}   out {}", number(answer.in), number(answer.out));
}

inline void add_severity(Lines& lines, double length, double ulps) {
  lines.add("severity", "{} = {} ulps of the largest coordinate", number(length), ulps);
}

}  // namespace plumbline
