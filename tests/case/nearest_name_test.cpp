#include "case/nearest_name.h"

#include <gtest/gtest.h>

#include <array>

namespace plumbline {
namespace {

constexpr std::array<std::string_view, 4> names = {"triangle", "ray", "t_min", "t_max"};

TEST(NearestName, SuggestsWhatIsClose) {
  EXPECT_EQ(suggest("trianlge", names), "did you mean 'triangle'?");  // two neighbours swapped
  EXPECT_EQ(suggest("trangle", names), "did you mean 'triangle'?");
  EXPECT_EQ(suggest("rays", names), "did you mean 'ray'?");
  EXPECT_EQ(suggest("tmax", names), "did you mean 't_max'?");
}

TEST(NearestName, ListsAllWhereNoneIsClose) {
  EXPECT_EQ(suggest("colour", names), "known: triangle, ray, t_min, t_max");
  EXPECT_EQ(suggest("x", names), "known: triangle, ray, t_min, t_max");
  EXPECT_EQ(suggest(std::string(100'000, 'x'), names), "known: triangle, ray, t_min, t_max");
}

}  // namespace
}  // namespace plumbline
