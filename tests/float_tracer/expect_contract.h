// Compares a tracer's contract, field by field, with what its documentation says.
#pragma once
#include <gtest/gtest.h>

#include <string_view>

#include "tests/float_tracer/shoot.h"

namespace plumbline {

inline void expect_contract(std::string_view tracer, const Contract& documented) {
  SCOPED_TRACE(tracer);
  const Contract& contract = tracer_named(tracer).info().contract;
  EXPECT_EQ(contract.precision, documented.precision);
  EXPECT_EQ(contract.edges, documented.edges);
  EXPECT_EQ(contract.range, documented.range);
  EXPECT_EQ(contract.t_min, documented.t_min);
  EXPECT_EQ(contract.t_max, documented.t_max);
  EXPECT_EQ(contract.coplanar, documented.coplanar);
  EXPECT_EQ(contract.degenerate, documented.degenerate);
  EXPECT_EQ(contract.culling, documented.culling);
  EXPECT_EQ(contract.slack_absolute, documented.slack_absolute);
  EXPECT_EQ(contract.slack_relative, documented.slack_relative);
}

}  // namespace plumbline
