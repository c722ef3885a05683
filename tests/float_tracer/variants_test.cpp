// That each variant is another tracer than its kernel, and that none of them changes another.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "float_tracer/float_environment.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

// Rays aimed at points on the edge bc of random triangles, all binary32: how many answers differ in outcome, t, u or v.
int differences(const std::string& tracer, const std::string& variant) {
  std::mt19937_64 random(7);
  const auto x = [&] { return static_cast<double>(std::ldexp(static_cast<float>(random() >> 40), -23)); };
  int count = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a{x(), x(), x()}, b{x(), x(), x()}, c{x(), x(), x()}, o{x(), x(), x()};
    const auto toward = [](double p, double q, double from) { return static_cast<float>((p + q) / 2 - from); };
    const Ray ray{.origin = o, .direction = {toward(b.x, c.x, o.x), toward(b.y, c.y, o.y), toward(b.z, c.z, o.z)}};
    const Answer one = shoot(tracer, {.triangles = {{a, b, c}}}, ray);
    const Answer other = shoot(variant, {.triangles = {{a, b, c}}}, ray);
    count += one.outcome != other.outcome || one.t != other.t || one.u != other.u || one.v != other.v;
  }
  return count;
}

bool has(const std::string& name) {
  for (const auto& tracer : listed_tracers())
    if (tracer->info().name == name) return true;
  return false;
}

TEST(Variants, ContractionAndFastMathChangeAnswers) {
  for (const std::string kernel : {"moller_trumbore", "woop_watertight", "plucker", "baldwin_weber"})
    for (const std::string precision : {"_f32", "_f64"}) {
      const std::string name = kernel + precision;
      if (has(name + "_fma")) {
        EXPECT_GT(differences(name, name + "_fma"), 0) << name;
      }
      // g++ 12 makes the same of Moller and Trumbore's test, whose sums and one reciprocal leave it little to change.
      if (kernel != "moller_trumbore") {
        EXPECT_GT(differences(name, name + "_fast_math"), 0) << name;
      }
      EXPECT_EQ(differences(name, name + "_ftz_daz"), 0) << name;  // no subnormals here
    }
}

// det = 2^-127 is subnormal in binary32, its reciprocal is not infinite.
TEST(Variants, FlushedResultsLoseWhatIsSubnormal) {
  const double s = 0x1p-64;
  const Bag bag{.triangles = {{{0, 0, 0}, {s, 0, 0}, {0, 2 * s, 0}}}};
  const Ray ray{.origin = {s / 4, s / 4, 1}, .direction = {0, 0, -1}};
  EXPECT_EQ(shoot("moller_trumbore_f32", bag, ray).outcome, Outcome::hit);
  const FloatEnvironment before;
  EXPECT_EQ(shoot("moller_trumbore_f32_ftz_daz", bag, ray).outcome, Outcome::miss);
  EXPECT_FALSE(before.restore()) << "the controls stayed as they were";
  EXPECT_EQ(shoot("moller_trumbore_f64_ftz_daz", bag, ray).outcome, Outcome::hit);
}

}  // namespace
}  // namespace plumbline
