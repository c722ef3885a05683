// Findings made plain: their final forms, what each Keep keeps, and that an independent judge calls the results
// findings as well.
#include "analysis/shrink.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>
#include <map>
#include <sstream>
#include <string>

#include "analysis/tracers.h"
#include "case/case_text.h"
#include "tests/judges/rational_judge.h"

namespace plumbline {
namespace {

struct Found {
  std::string id;
  const Tracer* tracer;
  FuzzInput input;
};

// From shrink_findings.case.
const std::vector<Found>& findings() {
  static const std::vector<Found> list = [] {
    std::vector<Found> found;
    for (const Case& c : read_cases(PLUMBLINE_SOURCE_DIR "/tests/analysis/shrink_findings.case")) {
      const Tracer* tracer = tracer_named(c.known.at(0).tracer);
      found.push_back({c.id, tracer, from_case(c, c.aim ? Space::target : Space::ray, c.precision).value()});
    }
    return found;
  }();
  return list;
}

// Its numbers, as a .case file has them.
std::string form(const FuzzInput& input) {
  Case c = to_case(input);
  c.id = "plain";
  std::istringstream text(to_text(c));
  std::string numbers;
  for (std::string line; std::getline(text, line);)
    if (line.starts_with("triangle") || line.starts_with("ray") || line.starts_with("range") ||
        line.starts_with("aim"))
      numbers += line + '\n';
  return numbers;
}

Signature signature_of(const Examination& e, const FuzzInput& input) {
  const Case c = to_case(input);
  return signature(e, c.aim ? c.aim->wish : Wish::none).value();
}

void expect_kept(const Shrunk& s, const FuzzInput& found, Keep keep) {
  const Signature before = signature_of(s.before, found), after = signature_of(s.after, s.input);
  EXPECT_EQ(after.kind, before.kind);
  EXPECT_EQ(after.element, before.element);
  EXPECT_EQ(after.rejection, before.rejection);
  EXPECT_EQ(after.boundary, before.boundary);
  EXPECT_EQ(after.lucky, before.lucky);
  if (keep != Keep::simple) EXPECT_EQ(after.conditioning, before.conditioning);
  if (keep == Keep::worst) {
    EXPECT_EQ(after, before);
    EXPECT_GE(s.after.severity_ulps(), s.before.severity_ulps() / 2);
  }
  EXPECT_EQ(s.bits_before, significant_bits(found));
  EXPECT_EQ(s.bits_after, significant_bits(s.input));
  EXPECT_LT(s.bits_after, s.bits_before);
  EXPECT_EQ(s.input.space, found.space);
  EXPECT_EQ(s.input.precision, found.precision);
  EXPECT_TRUE(in_domain(s.input, Domain::nominal));
}

// Nothing of the oracle's: the meeting and S^2 in Boost's rationals.
void expect_found_by_another_judge(const Shrunk& s, const Tracer& tracer) {
  const Ray ray = ray_of(s.input);
  Answer answer;
  tracer.prepare({.triangles = {s.input.triangle}})->trace({&ray, 1}, {&answer, 1});
  const Truth truth = judges::rational_meeting(s.input.triangle, ray).truth;
  const bool hit = truth.hit_class <= HitClass::vertex && truth.versus_t_min >= 0 && truth.versus_t_max <= 0;
  EXPECT_NE(answer.outcome == Outcome::hit, hit);
  EXPECT_EQ(s.after.verdict, hit ? VerdictKind::false_miss : VerdictKind::false_hit);
  EXPECT_GT(judges::squared_severity(s.input.triangle, ray, !hit), 0);
  EXPECT_GT(s.after.severity_ulps(), 0);
}

class Shrink : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Findings, Shrink, testing::Range(std::size_t{0}, std::size_t{6}));

TEST_P(Shrink, KeepsWhatItIsTold) {
  ASSERT_EQ(findings().size(), 6u);
  const Found& found = findings().at(GetParam());
  for (const Keep keep : {Keep::simple, Keep::worst}) {
    SCOPED_TRACE(name(keep));
    const auto s = shrink(found.input, *found.tracer, keep);
    ASSERT_TRUE(s.has_value());
    expect_kept(*s, found.input, keep);
    expect_found_by_another_judge(*s, *found.tracer);
  }
}

TEST_P(Shrink, ComesToItsFinalForm) {
  const std::map<std::string, std::string> forms = {
      {"false-hit-bc-nominal-c1",
       R"(triangle 0x1p+1 0x0p+0 0x0p+0   0x0p+0 0x1p+0 0x0p+0   0x1p+0 0x1p+0 -0x1p+0
ray 0x0p+0 -0x1p-20 0x1p+0   0x1.ffffep-21 0x1p+0 -0x1p+0
range 0x0p+0 inf
)"},
      {"false-hit-ab-sliver-c2",
       R"(triangle 0x1p+15 0x1p+0 0x0p+0   0x0p+0 -0x1p-15 0x0p+0   0x0p+0 0x0p+0 0x0p+0
ray 0x1.fffc0008p-1 0x0p+0 0x0p+0   0x0p+0 0x0p+0 0x1p+0
range 0x0p+0 inf
)"},
      {"false-hit-bc-nominal-c0",
       R"(triangle 0x0p+0 0x0p+0 0x0p+0   0x0p+0 0x1p+1 0x1p-20   0x1p+1 0x1.fp-20 0x0p+0
ray 0x1p+0 0x1p+0 0x0p+0   0x1p+0 0x1p+0 0x1p+0
range 0x0p+0 inf
)"},
      {"false-miss-t_min-by-t-nominal-c1",
       R"(triangle -0x1.9p-7 -0x1p+0 0x0p+0   0x1p+0 0x0p+0 0x1p+5   0x1p-2 0x1p+1 -0x1.8p+9
ray 0x0p+0 0x0p+0 0x1p+0   0x1p-1 0x0p+0 0x1.8p-1
range 0x1.cf438p+0 inf
)"},
      {"target-false-miss-bc-by-bc-nominal-c1",
       R"(triangle -0x1p+1 0x1p+0 0x0p+0   0x0p+0 0x0p+0 0x1p+1   0x0p+0 -0x1p+0 0x1p+0
ray -0x1.83735e84dd6f7p+1 -0x1.2f8e267ae76c8p+1 0x1.d50bace0ea7d6p+1   0x1.7488e369e0355p-1 0x1.f0b6848d2af1cp-2 -0x1.f0b6848d2af1cp-2
range 0x0p+0 inf
aim tolerance 0x1p-1 standoff 0x1.0a4p+2 wish hit
)"},
      {"target-false-hit-ab-nominal-c0",
       R"(triangle 0x0p+0 0x1p-3 0x1p-6   0x1p+0 0x1p+0 -0x1p+0   0x0p+0 0x0p+0 0x0p+0
ray 0x1.bd5c6p+1 0x1.da06ap-3 0x1.13fcc2p+1   -0x1.7d5c5cp-1 0x1.52fcc4p-4 -0x1.52fcc4p-1
range 0x0p+0 inf
aim tolerance 0x1p-21 standoff 0x1p+2 wish miss
)"}};
  const Found& found = findings().at(GetParam());
  const auto s = shrink(found.input, *found.tracer, Keep::nominal);
  ASSERT_TRUE(s.has_value());
  std::printf("%s: %u -> %u significant bits, %llu tries\n", found.id.c_str(), s->bits_before, s->bits_after,
              static_cast<unsigned long long>(s->tries));
  EXPECT_EQ(form(s->input), forms.at(found.id));
  expect_kept(*s, found.input, Keep::nominal);
  expect_found_by_another_judge(*s, *found.tracer);
  // The same every time; and from there it only goes on.
  const auto again = shrink(found.input, *found.tracer, Keep::nominal);
  EXPECT_EQ(again->input, s->input);
  EXPECT_EQ(again->tries, s->tries);
  EXPECT_LE(shrink(s->input, *found.tracer, Keep::nominal)->bits_after, s->bits_after);
}

TEST(Shrink, ARightCaseGivesNothing) {
  for (const Found& found : findings())
    for (const Keep keep : {Keep::simple, Keep::nominal, Keep::worst})
      EXPECT_FALSE(shrink(found.input, *tracer_named("exact"), keep).has_value());
  FuzzInput hit;
  hit.triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  hit.ray = {.origin = {0x1p-2, 0x1p-2, 1}, .direction = {0, 0, -1}};
  EXPECT_FALSE(shrink(hit, *tracer_named("moller_trumbore_f64"), Keep::simple).has_value());
}

TEST(Shrink, SignificantBits) {
  FuzzInput x;
  EXPECT_EQ(significant_bits(x), 0u);
  x.triangle.a = {1, -2, 0x1p-30};
  EXPECT_EQ(significant_bits(x), 3u);
  x.triangle.b = {3, 5, -0.0};  // 2 and 3 bits
  EXPECT_EQ(significant_bits(x), 8u);
  x.ray.origin.x = 0x1.0000000000001p+0;
  EXPECT_EQ(significant_bits(x), 61u);
  x.ray.t_max = 12;
  EXPECT_EQ(significant_bits(x), 63u);
  x.ray.t_min = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(significant_bits(x), 63u);
  x.ray.origin.y = 0x1p-1074;
  EXPECT_EQ(significant_bits(x), 64u);
  // In the target space tolerance and standoff count, the ray doesn't.
  x.space = Space::target;
  x.tolerance = 0x1.8p-3, x.standoff = 5;
  EXPECT_EQ(significant_bits(x), 8u + 2 + 3);
}

}  // namespace
}  // namespace plumbline
