// The disagreements of campaigns, judged again by a judge that shares nothing with the oracle (tests/judges).
#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>

namespace plumbline {

/// Both spaces: `nominal` disagreements each of the nominal domain, `full` each of the full one. Class, signs and
/// verdict have to be the judge's; the severity has to be 0 where the judge's is, and elsewhere within 2^-39 of it.
/// The tracer's contract is closed and two-sided, and any contact without a crossing counts as a miss.
void rejudge(std::string_view tracer, std::uint64_t seed, std::uint64_t nominal, std::uint64_t full);

inline const auto rejudged_tracers = testing::Values("moller_trumbore_f32", "moller_trumbore_f64",
                                                     "woop_watertight_f32", "plucker_f64", "baldwin_weber_f32");

}  // namespace plumbline
