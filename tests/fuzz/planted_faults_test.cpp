// A check that the search can find: Moller-Trumbore in binary64 with one fault planted in it, which is seen where
// the search comes upon it, and which has to stand out from what rounding does to the same kernel without the
// fault.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "analysis/signature.h"
#include "float_tracer/kernel_tracer.h"
#include "float_tracer/moller_trumbore.h"
#include "tests/fuzz/searched.h"

namespace plumbline {
namespace {

enum class Fault : unsigned char {
  none,
  flipped_near_ab,  ///< v >= 0 is v < 0 within 2^-20 of the edge
  epsilon_on_u,     ///< u >= -2^-30 will do
  exponent_pair,    ///< wrong where a.x is in [32, 64) and direction.z in [2^-7, 2^-6), signs aside
  w_for_v,          ///< of a hit, the weight of a is told as that of c
};
constexpr std::array<std::string_view, 5> fault_names = {"none", "flipped_near_ab", "epsilon_on_u", "exponent_pair",
                                                         "w_for_v"};

template <Fault planted>
struct Faulty {
  using Scalar = double;
  static constexpr std::string_view name = fault_names[static_cast<unsigned>(planted)];
  static constexpr std::string_view summary = "Moller-Trumbore with a fault", source = "this test";
  struct PreparedTriangle {
    explicit PreparedTriangle(const KernelTriangle<double>& t) : a(t.a), ab(t.b - t.a), ac(t.c - t.a) {}
    Vec<double> a, ab, ac;
  };
  using PreparedRay = KernelRay<double>;

  template <class Why = Unasked>
  static std::optional<KernelHit<double>> intersect(const PreparedTriangle& triangle, const PreparedRay& ray,
                                                    Why why = {}) {
    if (planted == Fault::exponent_pair && std::ilogb(triangle.a.x) == 5 && std::ilogb(ray.direction.z) == -7)
      return missed_by(Rejection::parallel, why);
    const Vec<double> p = cross(ray.direction, triangle.ac);
    const double det = dot(triangle.ab, p);
    if (det == 0) return missed_by(Rejection::parallel, why);
    const double inverse = 1 / det;

    const Vec<double> from_a = ray.origin - triangle.a;
    const double u = dot(from_a, p) * inverse;
    const double least = planted == Fault::epsilon_on_u ? -0x1p-30 : 0;
    if (!(u >= least && u <= 1))
      return missed_by([=] { return !(u >= least) ? Rejection::ca : Rejection::bc; }, why);

    const Vec<double> q = cross(from_a, triangle.ab);
    const double v = dot(ray.direction, q) * inverse;
    const bool flipped = planted == Fault::flipped_near_ab && std::abs(v) < 0x1p-20;
    const bool inside = flipped ? v < 0 : v >= 0;
    if (!(inside && u + v <= 1)) return missed_by([=] { return !inside ? Rejection::ab : Rejection::bc; }, why);

    const double t = dot(triangle.ac, q) * inverse;
    if (!ray.holds(t)) return missed_by(Rejection::t, why);
    return KernelHit<double>{t, u, planted == Fault::w_for_v ? 1 - u - v : v};
  }
};

constexpr std::uint64_t ordinarily = 500000, most = 2000000, seed = 20260101;
constexpr double far_above = 0x1p+8;

template <Fault planted>
CampaignPlan plan_of() {
  static const KernelTracer<Faulty<planted>> tracer;
  return {.tracer = &tracer, .seed = seed};
}

// What the kernel without a fault comes to, by how well a case is conditioned: the worst severity among the
// findings of a bucket; and the greatest displacement of u and v in a nominal case.
struct Ordinary {
  std::array<double, 5> severity{};
  double displacement = 0;
};
const Ordinary& ordinary() {
  static const Ordinary o = [] {
    Ordinary found;
    Campaign clean(plan_of<Fault::none>());
    while (clean.executions() < ordinarily) {
      clean.test(clean.next());
      if (clean.last_features().nominal)
        found.displacement = std::max(found.displacement, clean.last_features().error);
    }
    for (const auto& [key, f] : clean.findings()) {
      double& worst = found.severity.at(f.signature.bucket);
      worst = std::max(worst, f.ulps);
    }
    std::printf("without a fault: %g, %g, %g, %g, %g ulps, by condition; displacement %g ulps\n", found.severity[0],
                found.severity[1], found.severity[2], found.severity[3], found.severity[4], found.displacement);
    return found;
  }();
  return o;
}

bool stands_out(const Finding& f) {
  return f.signature.conditioning == Conditioning::nominal &&
         f.ulps > far_above * ordinary().severity.at(f.signature.bucket);
}

// The first finding that stands out.
template <Fault planted>
std::optional<Finding> caught() {
  Campaign campaign(plan_of<planted>());
  std::optional<Finding> found;
  campaign.on_finding = [&](const Finding& f) {
    if (!found && stands_out(f)) found = f;
  };
  while (!found && campaign.executions() < most) campaign.test(campaign.next());
  if (found)
    std::printf("%s: seed %llu, execution %llu, %s, %g ulps\n", fault_names[static_cast<unsigned>(planted)].data(),
                static_cast<unsigned long long>(seed), static_cast<unsigned long long>(found->execution),
                to_word(found->signature).c_str(), found->ulps);
  return found;
}

TEST(PlantedFaults, WithoutOneTheKernelIsMollerTrumbore) {
  const auto print = [](const CampaignPlan& plan) { return fingerprint(searched(plan, 20000).elites()); };
  EXPECT_EQ(print(plan_of<Fault::none>()), print(plan_for("moller_trumbore_f64", seed)));
}

// One test, so that the kernel without a fault is searched once.
TEST(PlantedFaults, StandOut) {
  const auto flipped = caught<Fault::flipped_near_ab>();
  ASSERT_TRUE(flipped);
  EXPECT_EQ(flipped->signature.element, Element::ab);

  const auto epsilon = caught<Fault::epsilon_on_u>();
  ASSERT_TRUE(epsilon);
  EXPECT_EQ(epsilon->signature.kind, FindingKind::false_hit);
  EXPECT_EQ(epsilon->signature.element, Element::ca);

  const auto pair = caught<Fault::exponent_pair>();
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->signature.kind, FindingKind::false_miss);
  EXPECT_EQ(pair->signature.rejection, Rejection::parallel);

  // No verdict speaks of u and v: this one stands out by the displacement that elites are kept for.
  Campaign campaign(plan_of<Fault::w_for_v>());
  double displacement = 0;
  while (displacement <= far_above * ordinary().displacement && campaign.executions() < most) {
    campaign.test(campaign.next());
    if (campaign.last_features().nominal) displacement = std::max(displacement, campaign.last_features().error);
  }
  std::printf("w_for_v: seed %llu, execution %llu, displacement %g ulps\n", static_cast<unsigned long long>(seed),
              static_cast<unsigned long long>(campaign.executions()), displacement);
  EXPECT_GT(displacement, far_above * ordinary().displacement);
  EXPECT_TRUE(
      std::ranges::any_of(campaign.elites().all(), [&](const Elite& e) { return e.drive == displacement; }));
}

}  // namespace
}  // namespace plumbline
