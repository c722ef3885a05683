// Libraries that decide exactly, each judged by what it was really asked: they share no line with the oracle, and
// agree with it on all families, in numbers of binary32 and binary64 by turns. PLUMBLINE_CASES: how many of each.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "analysis/ask.h"
#include "analysis/tracers.h"
#include "case/case_text.h"
#include "case/hard_families.h"
#include "oracle/classify.h"
#include "tests/judges/seed.h"

namespace plumbline {
namespace {

struct ExactAdapter {
  const char* tracer;
  int least_exponent, largest_exponent;  // of the numbers that it is exact for
};
void PrintTo(const ExactAdapter& adapter, std::ostream* to) { *to << adapter.tracer; }

class ExactAdapters : public testing::TestWithParam<std::tuple<ExactAdapter, std::size_t>> {
 protected:
  const ExactAdapter& adapter() const { return std::get<0>(GetParam()); }

  bool in_range(double x) const {
    if (x == 0) return true;
    return std::ilogb(x) >= adapter().least_exponent && std::ilogb(x) <= adapter().largest_exponent;
  }
  bool in_range(const Vec3& v) const { return in_range(v.x) && in_range(v.y) && in_range(v.z); }
  bool in_range(const Triangle& t) const { return in_range(t.a) && in_range(t.b) && in_range(t.c); }
  // The two points of the line.
  bool in_range(const Query& q) const {
    const auto& [o, d, t_min, t_max] = q.ray;
    const Vec3& tail = q.direction_tail;
    return in_range(o) && in_range(Vec3{o.x + d.x + tail.x, o.y + d.y + tail.y, o.z + d.z + tail.z});
  }
};

std::uint64_t cases_of_each_family() {
  const char* text = std::getenv("PLUMBLINE_CASES");
  return text != nullptr ? std::strtoull(text, nullptr, 0) : 12000;
}

TEST_P(ExactAdapters, AgreeWithTheOracle) {
  const Tracer* const tracer = tracer_named(adapter().tracer);
  if (!tracer) GTEST_SKIP() << "not in this build";
  const auto family = static_cast<Family>(std::get<1>(GetParam()));
  const Contract& contract = tracer->info().contract;

  std::uint64_t beyond = 0;
  std::array<std::uint64_t, verdict_kind_names.size()> verdicts{};
  for (std::uint64_t i = 0; i < cases_of_each_family(); ++i) {
    const auto [triangle, ray] = draw(family, judges::seed(), i);
    Case asked;
    asked.id = std::to_string(i);
    asked.bag.triangles = {triangle};
    asked.ray = ray;
    if (i % 2 == 1) {
      const Case rounded = put_at(asked, Precision::binary32);
      if (classify(rounded.bag.triangles.front(), rounded.ray).invalid == Invalid::none) asked = rounded;
    }
    const Reply reply = ask(*tracer, asked);
    ASSERT_FALSE(reply.conduct.disturbed);
    if (!in_range(asked.bag.triangles.front()) || !in_range(reply.query)) {
      ++beyond;
      continue;
    }
    const VerdictKind verdict = judge(asked, reply, contract).verdict;
    ++verdicts[static_cast<unsigned>(verdict)];
    ASSERT_FALSE(wrong(verdict)) << name(verdict) << ", seed " << judges::seed() << "\n" << to_text(asked);
  }
  std::printf("%s %s: %llu right, %llu unspecified, %llu no answer, %llu beyond its range\n", adapter().tracer,
              name(family).data(), static_cast<unsigned long long>(verdicts[unsigned(VerdictKind::correct)]),
              static_cast<unsigned long long>(verdicts[unsigned(VerdictKind::unspecified)]),
              static_cast<unsigned long long>(verdicts[unsigned(VerdictKind::fault)]),
              static_cast<unsigned long long>(beyond));
}

// GTS: what Shewchuk promises of his predicates.
INSTANTIATE_TEST_SUITE_P(All, ExactAdapters,
                         testing::Combine(testing::Values(ExactAdapter{"gts_segment_f64", -142, 201},
                                                          ExactAdapter{"cgal_epick", -1074, 1023},
                                                          ExactAdapter{"cgal_epeck", -1074, 1023}),
                                          testing::Range<std::size_t>(0, family_names.size())),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param).tracer) + "_" +
                                  std::string(family_names[std::get<1>(info.param)]);
                         });

}  // namespace
}  // namespace plumbline
