// Shortcuts of the tracer tests.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "float_tracer/tracer_list.h"

namespace plumbline {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

inline const std::vector<std::unique_ptr<Tracer>>& listed_tracers() {
  static const auto tracers = float_tracers();
  return tracers;
}

/// The tracer must be there.
inline const Tracer& tracer_named(std::string_view name) {
  return **std::ranges::find_if(listed_tracers(), [&](const auto& t) { return t->info().name == name; });
}

inline Answer shoot(const Tracer& tracer, const Bag& bag, const Ray& ray) {
  Answer answer;
  tracer.prepare(bag)->trace({&ray, 1}, {&answer, 1});
  return answer;
}

inline Answer shoot(std::string_view tracer, const Bag& bag, const Ray& ray) {
  return shoot(tracer_named(tracer), bag, ray);
}

/// The nine coordinates of a triangle, or the six of a ray, to be spoilt one at a time.
inline std::vector<double*> coordinates(Triangle& t) {
  return {&t.a.x, &t.a.y, &t.a.z, &t.b.x, &t.b.y, &t.b.z, &t.c.x, &t.c.y, &t.c.z};
}
inline std::vector<double*> coordinates(Ray& r) {
  return {&r.origin.x, &r.origin.y, &r.origin.z, &r.direction.x, &r.direction.y, &r.direction.z};
}

}  // namespace plumbline

// Names in the messages of parameterised tests.
inline std::string parameter_name(const testing::TestParamInfo<std::string>& info) { return info.param; }
