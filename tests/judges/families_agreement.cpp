#include "tests/judges/families_agreement.h"

#include <cstdio>

#include "oracle/measure.h"
#include "tests/judges/agreement.h"
#include "tests/judges/epeck_judge.h"
#include "tests/judges/rational_judge.h"

namespace plumbline::judges {
namespace {

template <class Real>
void check_rounding(const RationalMeeting& m, const Shot& s) {
  const auto at = measure<Real>(s.triangle, s.ray);
  ASSERT_TRUE(at.has_value());
  ASSERT_TRUE(is_rounded(m.t, at->t)) << "t\n" << explain(s.triangle, s.ray);
  ASSERT_TRUE(is_rounded(m.u, at->u)) << "u\n" << explain(s.triangle, s.ray);
  ASSERT_TRUE(is_rounded(m.v, at->v)) << "v\n" << explain(s.triangle, s.ray);
}

void check_rational(const Shot& s, const Truth& truth, Agreement& agreement) {
  const RationalMeeting m = rational_meeting(s.triangle, s.ray);
  ASSERT_NO_FATAL_FAILURE(expect_agreement(s.triangle, s.ray, truth, m));
  if (truth.det_sign == 0) return;
  ++agreement.crossings;
  check_rounding<double>(m, s);
  check_rounding<float>(m, s);
}

void check_one(const Shot& s, bool rational, Agreement& agreement) {
  const Truth truth = classify(s.triangle, s.ray);
  if (truth.invalid == Invalid::none) {
    ASSERT_NO_FATAL_FAILURE(expect_agreement(s.triangle, s.ray, truth, epeck_judged(s.triangle, s.ray)));
  }
  if (rational) check_rational(s, truth, agreement);
  ++agreement.cases;
}

}  // namespace

Agreement check_family(Family family, std::uint64_t from, std::uint64_t count, std::uint64_t rational_every) {
  Agreement agreement;
  for (std::uint64_t i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "family " << name(family) << " seed " << from << " index " << i);
    check_one(draw(family, from, i), i % rational_every == 0, agreement);
  }
  std::printf("%-13s seed %llu: %llu cases, t u v of %llu\n", name(family).data(), static_cast<unsigned long long>(from),
              static_cast<unsigned long long>(agreement.cases), static_cast<unsigned long long>(agreement.crossings));
  return agreement;
}

}  // namespace plumbline::judges
