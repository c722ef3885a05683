// What tests of several libraries expect of the same rays.
#pragma once
#include <gtest/gtest.h>

#include <initializer_list>
#include <string_view>

#include "tests/float_tracer/shoot.h"

namespace plumbline {

/// Of each coordinate of the triangle and of the ray, which hits it, being one of these alone.
inline void expect_faults(std::string_view tracer, const Triangle& triangle, const Ray& ray,
                          std::initializer_list<double> spoils) {
  const auto outcome = [&](const Triangle& t, const Ray& r) { return shoot(tracer, {.triangles = {t}}, r).outcome; };
  for (const double bad : spoils) {
    for (std::size_t i = 0; i < 9; ++i) {
      Triangle spoilt = triangle;
      *coordinates(spoilt)[i] = bad;
      EXPECT_EQ(outcome(spoilt, ray), Outcome::fault) << "triangle coordinate " << i << " = " << bad;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      Ray spoilt = ray;
      *coordinates(spoilt)[i] = bad;
      EXPECT_EQ(outcome(triangle, spoilt), Outcome::fault) << "ray coordinate " << i << " = " << bad;
    }
  }
}

/// Of a ray that hits the triangle at t = 4 and, begun at t = 5, has it behind.
inline void expect_range_searched(std::string_view tracer, const Triangle& triangle, Ray ray) {
  const auto within = [&](double t_min, double t_max) {
    ray.t_min = t_min, ray.t_max = t_max;
    return shoot(tracer, {.triangles = {triangle}}, ray).outcome;
  };
  EXPECT_EQ(within(0, 3), Outcome::miss);
  EXPECT_EQ(within(0, 5), Outcome::hit);
  EXPECT_EQ(within(5, infinity), Outcome::miss);
  EXPECT_EQ(within(-infinity, infinity), Outcome::hit);
}

}  // namespace plumbline
