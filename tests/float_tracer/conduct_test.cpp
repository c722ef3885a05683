// What people are told of a tracer beside its answers.
#include "float_tracer/conduct.h"

#include <gtest/gtest.h>

namespace plumbline {
namespace {

TEST(Conduct, ComplainsInWholeSentences) {
  EXPECT_EQ(complaints("x", {}), "");
  EXPECT_EQ(complaints("x", {.deaths = {{"SIGABRT", 1}}}), "x: died of 1 ray (SIGABRT); it is a fault\n");
  EXPECT_EQ(complaints("x", {.disturbed = true, .deaths = {{"SIGABRT", 3}}}),
            "x: died of 3 rays (SIGABRT); these are faults\nx: left the floating-point controls changed\n");
  EXPECT_EQ(complaints("x", {.deaths = {{"SIGABRT", 2}, {"exit code 0", 1}}}),
            "x: died of 3 rays (SIGABRT: 2, exit code 0: 1); these are faults\n");
  EXPECT_EQ(complaints("x", {.breaches = {{"lies", 1}, {"steals", 3}}}), "x: lies\nx: steals (3 times)\n");
}

TEST(Conduct, AddsUp) {
  Conduct sum{.deaths = {{"SIGABRT", 1}}, .breaches = {{"lies", 1}}};
  sum += {.disturbed = true, .deaths = {{"SIGABRT", 2}, {"SIGFPE", 4}}, .breaches = {{"lies", 2}}};
  sum += {};
  EXPECT_EQ(sum, (Conduct{
                     .disturbed = true, .deaths = {{"SIGABRT", 3}, {"SIGFPE", 4}}, .breaches = {{"lies", 3}}}));
}

}  // namespace
}  // namespace plumbline
