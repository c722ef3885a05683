// The same by GoogleTest.
#include <gtest/gtest.h>
#include <oracle/classify.h>
#include <plumbline_gtest.h>

#include "hits.h"

namespace {

bool hits(const plumbline::Triangle& triangle, const plumbline::Ray& ray, double flat) {
  const auto& [a, b, c] = triangle;
  const auto& [o, d, t_min, t_max] = ray;
  const double vertices[] = {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z};
  const double origin[] = {o.x, o.y, o.z}, direction[] = {d.x, d.y, d.z};
  return ::hits(vertices, origin, direction, t_min, t_max, flat) != 0;
}

plumbline::CorpusTracer tracer(double flat) {
  return {.name = "consumer_tracer",
          .hits = [flat](const auto& triangle, const auto& ray) { return hits(triangle, ray, flat); }};
}

}  // namespace

TEST(Unit, RightOnTheCorpus) { EXPECT_TRUE(plumbline::right_on_corpus(CORPUS, tracer(0))); }
TEST(Unit, WrongOnTheCorpus) { EXPECT_TRUE(plumbline::right_on_corpus(CORPUS, tracer(1e-3))); }
TEST(Unit, NoCorpus) { EXPECT_TRUE(plumbline::right_on_corpus(CORPUS "/none", tracer(0))); }

TEST(Unit, TruthInProcess) {
  const plumbline::Triangle triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const plumbline::Ray ray = {.origin = {0.5, 0, 1}, .direction = {0, 0, -1}};
  const plumbline::Truth truth = plumbline::classify(triangle, ray);
  EXPECT_EQ(truth.hit_class, plumbline::HitClass::edge);
  EXPECT_EQ(truth.feature, plumbline::Feature::ab);
}
