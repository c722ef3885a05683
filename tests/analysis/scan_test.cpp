#include "analysis/scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "analysis/scan_rays.h"
#include "analysis/scan_table.h"
#include "analysis/tracers.h"
#include "case/input_error.h"
#include "mesh/sphere.h"
#include "oracle/bag/scene.h"
#include "oracle/judge.h"
#include "tests/analysis/faulty_tracer.h"
#include "tests/analysis/fixed_tracer.h"

namespace plumbline {
namespace {

Mesh sphere(std::uint64_t triangles, Precision precision = Precision::binary32) {
  SphereOptions options;
  options.triangles = triangles;
  options.jitter = 0.01;
  options.precision = precision;
  return make_sphere(options);
}

std::vector<ScanSet> sets_of(const std::shared_ptr<ScanRays>& rays, std::uint64_t each) {
  std::vector<ScanSet> sets;
  for (std::size_t k = 0; k < scan_aim_names.size(); ++k) {
    const auto aim = static_cast<ScanAim>(k);
    sets.push_back({std::string(name(aim)), each, [rays, aim](std::uint64_t i) { return rays->ray(aim, i); }});
  }
  return sets;
}

struct Scanned {
  Mesh mesh;
  ScanPlan plan;
  std::vector<ScanFinding> findings;
  ScanResult result;

  Scanned(Mesh m, const std::vector<const Tracer*>& tracers, std::uint64_t each, unsigned jobs = 2)
      : mesh(std::move(m)) {
    plan.mesh = &mesh;
    plan.sets = sets_of(std::make_shared<ScanRays>(mesh, 1), each);
    plan.tracers = tracers;
    plan.jobs = jobs;
    plan.on_finding = [this](const ScanFinding& f) { findings.push_back(f); };
    result = scan(plan, blank(plan), false, {});
  }
  Scanned(const Scanned&) = delete;

  ScanTally sum(std::size_t tracer) const {
    ScanTally all;
    for (const auto& tallies : result.state.tallies) all += tallies[tracer];
    return all;
  }
};

std::uint64_t rays(const ScanTally& t) {
  std::uint64_t n = 0;
  for (const std::uint64_t count : t.verdicts) n += count;
  return n;
}

// Asked about the whole mesh, of more than whole_limit triangles, or of fewer.
class Whole final : public Tracer {
 public:
  explicit Whole(const Tracer& tracer) : Tracer(with_tree(tracer.info())), tracer_(tracer) {}
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override { return tracer_.prepare(bag); }

 private:
  static TracerInfo with_tree(TracerInfo info) {
    info.has_tree = true;
    return info;
  }
  const Tracer& tracer_;
};

TEST(Scan, OfWhatIsRightFindsNothing) {
  for (const std::uint64_t triangles : {320u, 5120u}) {
    const Scanned s(sphere(triangles), {&find_tracer("exact"), &find_tracer("cgal_epeck")}, 300);
    EXPECT_TRUE(s.result.complete);
    EXPECT_TRUE(s.findings.empty());
    for (const std::size_t t : {0u, 1u}) {
      const ScanTally sum = s.sum(t);
      EXPECT_EQ(rays(sum), 1500u);
      EXPECT_EQ(sum[BagVerdict::correct] + sum[BagVerdict::unspecified], 1500u);
    }
    std::uint64_t seen = 0;
    for (const ScanTruth& truth : s.result.state.truths)
      for (const std::uint64_t n : truth.nearest) seen += n;
    EXPECT_EQ(seen, 1500u);
  }
}

TEST(Scan, DoesNotDependOnThreadsOrOnBeingTakenUp) {
  const std::vector<const Tracer*> tracers = {&find_tracer("moller_trumbore_f32"), &find_tracer("woop_watertight_f64")};
  const Scanned one(sphere(320), tracers, 5000, 1), three(sphere(320), tracers, 5000, 3);
  EXPECT_EQ(one.result.state, three.result.state);
  EXPECT_GT(one.sum(0)[BagVerdict::leak] + one.sum(0)[BagVerdict::wrong_nearest], 0u);

  // Cut off after the first round, kept as a line, and taken up.
  std::atomic<bool> stop = false;
  const ScanResult part = scan(one.plan, blank(one.plan), stop, [&](const ScanProgress&) { stop = true; });
  EXPECT_FALSE(part.complete);
  EXPECT_LT(part.rays, 25'000u);
  const auto kept = from_line(to_line(part.state), one.plan);
  ASSERT_TRUE(kept);
  EXPECT_EQ(*kept, part.state);
  const ScanResult rest = scan(one.plan, *kept, false, {});
  EXPECT_EQ(rest.state, one.result.state);
  EXPECT_EQ(rest.rays + part.rays, 25'000u);
  EXPECT_EQ(to_csv(one.plan, rest.state), to_csv(three.plan, three.result.state));
}

TEST(Scan, ReadsNoOtherLine) {
  const Scanned s(sphere(80), {&find_tracer("exact")}, 10);
  const std::string line = to_line(s.result.state);
  EXPECT_TRUE(from_line(line, s.plan));
  EXPECT_FALSE(from_line("", s.plan));
  EXPECT_FALSE(from_line("done", s.plan));
  EXPECT_FALSE(from_line(line + " 1", s.plan));
  EXPECT_FALSE(from_line(line.substr(0, line.rfind(' ')), s.plan));
}

TEST(Scan, TellsPlantedFaults) {
  // The nearest is lost, now and then, where there are many triangles: in the tree, as it were.
  const Faulty loses([](std::vector<Met>& met, std::size_t bag) {
    if (bag > 100 && !met.empty() && met[0].triangle % 3 == 0) met.erase(met.begin());
  });
  const Whole culls(loses);
  const Scanned culled(sphere(1280), {&culls}, 200);
  const ScanTally lost = culled.sum(0);
  EXPECT_GT(lost.culled, 100u);
  EXPECT_EQ(lost.culled, lost[BagVerdict::leak] + lost[BagVerdict::wrong_nearest]);
  EXPECT_GT(lost.through, 0u);
  EXPECT_LE(lost.through, lost[BagVerdict::wrong_nearest]);
  for (const ScanFinding& f : culled.findings) {
    EXPECT_TRUE(f.signature.culling);
    EXPECT_TRUE(f.reproduced);  // with a few hundred triangles around
    EXPECT_GT(f.triangles.size(), 100u);
  }

  // A triangle test that misses: told with the triangles that the ray meets.
  const Faulty tests(
      [](std::vector<Met>& met, std::size_t) { std::erase_if(met, [](const Met& m) { return m.t < 0.75; }); });
  const Scanned missed(sphere(1280), {&tests}, 200);
  EXPECT_EQ(missed.sum(0).culled, 0u);
  EXPECT_GT(missed.sum(0)[BagVerdict::leak], 0u);
  EXPECT_GT(missed.sum(0).through, 0u);
  for (const ScanFinding& f : missed.findings) {
    EXPECT_FALSE(f.signature.culling);
    EXPECT_TRUE(f.reproduced);
    EXPECT_LT(f.triangles.size(), 100u);
  }

  // One that hits where nothing is.
  const Faulty ghosts([](std::vector<Met>& met, std::size_t) {
    if (met.empty()) met.push_back({0, {}, 1});
  });
  const Scanned seen(sphere(320), {&ghosts}, 200);
  EXPECT_GT(seen.sum(0)[BagVerdict::false_hit], 0u);
  EXPECT_EQ(seen.sum(0)[BagVerdict::false_hit], [&] {
    std::uint64_t nothing = 0;
    for (const ScanTruth& truth : seen.result.state.truths) nothing += truth.nearest[3];
    return nothing;
  }());
}

// Dies of what is hit near the origin of the ray.
class Mortal final : public Tracer {
 public:
  Mortal() : Tracer({.name = "mortal", .summary = "", .source = "", .contract = {}}) {}
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    struct Prepared final : PreparedBag {
      explicit Prepared(const Bag& b) : right(find_tracer("exact").prepare(b)) {}
      void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
        right->trace(rays, answers);
        for (Answer& a : answers) {
          if (a.outcome != Outcome::hit || a.t > 0.75) continue;
          a = {.outcome = Outcome::fault};
          ++conduct_.deaths["SIGABRT"];
        }
      }
      std::unique_ptr<PreparedBag> right;
    };
    return std::make_unique<Prepared>(bag);
  }
};

TEST(Scan, KeepsARayThatATracerDiedOf) {
  const Mortal mortal;
  for (const std::uint64_t triangles : {320u, 5120u}) {  // asked about all, and about those nearby
    const Scanned s(sphere(triangles), {&mortal}, 200);
    const ScanTally sum = s.sum(0);
    EXPECT_GT(sum[BagVerdict::fault], 1u);
    EXPECT_EQ(s.result.conduct[0].deaths, (std::map<std::string, std::uint64_t>{{"SIGABRT", sum[BagVerdict::fault]}}));
    ASSERT_EQ(s.findings.size(), 1u) << "of one kind";
    const ScanFinding& f = s.findings.front();
    EXPECT_EQ(to_word(f.signature), "death");
    EXPECT_TRUE(f.reproduced);
    EXPECT_LT(f.triangles.size(), 100u);
    EXPECT_EQ(signature(examine_bag(mortal, f.what)), death_signature);
  }
  // It says that it can't take a case: nothing to keep.
  const FixedTracer declines({.answer = {.outcome = Outcome::fault}});
  EXPECT_TRUE(Scanned(sphere(320), {&declines}, 20).findings.empty());
}

// The short way to a verdict is the long one's, whatever is promised.
TEST(Scan, JudgesAsABagIsJudged) {
  Mesh mesh;
  mesh.precision = Precision::binary32;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 2; ++z) mesh.vertices.push_back({double(x), double(y), double(z)});
  std::mt19937_64 random(1);
  for (int i = 0; i < 40; ++i) {
    const auto corner = [&] { return static_cast<std::uint32_t>(random() % mesh.vertices.size()); };
    mesh.triangles.push_back({corner(), corner(), corner()});  // some without area
  }
  std::vector<Ray> rays;
  for (int i = 0; i < 400; ++i) {
    const auto number = [&] { return static_cast<double>(random() % 7) - 3; };
    rays.push_back({.origin = {number(), number(), number()}, .direction = {number(), number(), number()}});
  }
  Bag bag = to_bag(mesh);
  for (unsigned k = 0; k < 27 * 3; ++k) {
    Contract c{.precision = Precision::binary32};
    c.coplanar = static_cast<TouchRule>(k % 3);
    c.degenerate = static_cast<TouchRule>(k / 3 % 3);
    c.edges = k / 9 % 3 == 0 ? EdgeRule::closed : k / 9 % 3 == 1 ? EdgeRule::unspecified : EdgeRule::open;
    c.culling = static_cast<Culling>(k / 27);
    // Right, or the second, or nothing, by turns.
    int turn = 0;
    const Faulty tracer(
        [&turn](std::vector<Met>& met, std::size_t) {
          ++turn;
          if (turn % 3 == 1 && !met.empty()) met.erase(met.begin());
          if (turn % 3 == 2) met.clear();
        },
        c);
    ScanPlan plan;
    plan.mesh = &mesh;
    plan.sets = {{"rays", rays.size(), [&](std::uint64_t i) { return rays[i]; }}};
    plan.tracers = {&tracer};
    const ScanResult result = scan(plan, blank(plan), false, {});
    ScanTally expected;
    turn = 0;
    for (const Ray& ray : rays) {
      Case what;
      what.precision = Precision::binary32;
      what.bag = bag;
      what.ray = ray;
      const Query query = searched_ray(ray, c);
      const BagTruth truth = bag_truth(bag.triangles, query);
      Answer answer;
      tracer.prepare(bag)->trace({&ray, 1}, {&answer, 1});
      ++expected.verdicts[static_cast<std::size_t>(judge_nearest({bag.triangles, query, truth, c}, answer).verdict)];
    }
    EXPECT_EQ(result.state.tallies[0][0].verdicts, expected.verdicts) << "contract " << k;
  }
}

TEST(Scan, PutsABinary32TracerARoundedMesh) {
  const Mesh mesh = sphere(320, Precision::binary64);
  ASSERT_EQ(mesh.precision, Precision::binary64);
  const Scanned s(mesh, {&find_tracer("woop_watertight_f32"), &find_tracer("exact")}, 300);
  EXPECT_EQ(s.sum(1)[BagVerdict::correct] + s.sum(1)[BagVerdict::unspecified], 1500u);
  EXPECT_GT(s.sum(0)[BagVerdict::correct], 1000u);
  for (const ScanFinding& f : s.findings) EXPECT_TRUE(f.reproduced);
}

TEST(ScanRays, AreAFunctionOfSeedAimAndIndex) {
  const Mesh mesh = sphere(320);
  const ScanRays rays(mesh, 7), again(mesh, 7), other(mesh, 8);
  for (std::size_t k = 0; k < scan_aim_names.size(); ++k) {
    const auto aim = static_cast<ScanAim>(k);
    EXPECT_EQ(rays.ray(aim, 5), again.ray(aim, 5));
    EXPECT_NE(rays.ray(aim, 5), rays.ray(aim, 6));
    EXPECT_NE(rays.ray(aim, 5), other.ray(aim, 5));
    for (std::uint64_t i = 0; i < 100; ++i) {
      const Ray ray = rays.ray(aim, i);
      for (const double x :
           {ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z})
        ASSERT_TRUE(is_binary32(x));
    }
  }
}

Mesh scaled(Mesh mesh, int exponent) {
  for (Vec3& v : mesh.vertices) v = {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
  return mesh;
}

// Radius 1 at most: up to an eighth of the largest number everything is as around 1, but for the exponents.
TEST(ScanRays, OfAHugeMeshOrATinyOneAreAsOthers) {
  const Mesh mesh = sphere(320, Precision::binary64);
  const ScanRays near(mesh, 1);
  for (const int exponent : {1020, 700, -700, -950}) {
    const Mesh other = scaled(mesh, exponent);
    const ScanRays rays(other, 1);
    for (std::size_t k = 0; k < scan_aim_names.size(); ++k) {
      const auto aim = static_cast<ScanAim>(k);
      for (std::uint64_t i = 0; i < 50; ++i) {
        const Ray ray = rays.ray(aim, i), plain = near.ray(aim, i);
        EXPECT_EQ(std::ldexp(ray.origin.x, -exponent), plain.origin.x) << name(aim) << ' ' << i << ' ' << exponent;
        EXPECT_EQ(std::ldexp(ray.direction.y, -exponent), plain.direction.y);
      }
    }
  }
  for (const Precision precision : {Precision::binary32, Precision::binary64}) {
    const Mesh beyond = scaled(sphere(320, precision), precision == Precision::binary32 ? 127 : 1023);
    EXPECT_THROW(ScanRays(beyond, 1), InputError);
    EXPECT_THROW(ShotlineGrid(beyond, 0, 0, 0x1p+1000), InputError);
  }
  const Mesh far = scaled(mesh, 200);
  EXPECT_THROW(Scanned(far, {&find_tracer("woop_watertight_f32")}, 1), InputError) << "of binary32";
  EXPECT_NO_THROW(Scanned(far, {&find_tracer("woop_watertight_f64")}, 1));
}

TEST(ScanRays, MeetWhatTheyAreAimedAt) {
  const Mesh mesh = sphere(320);
  const Scene scene(to_bag(mesh).triangles);
  const ScanRays rays(mesh, 1);
  std::uint64_t at_vertices = 0, at_edges = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const BagTruth truth = scene.truth(rays.ray(ScanAim::vertex, i));
    for (const BagHit& hit : truth.hits) at_vertices += hit.truth.hit_class == HitClass::vertex;
    // What is aimed at is at t = 1; an edge where the mesh turns away may be passed by.
    const BagTruth edge = scene.truth(rays.ray(ScanAim::edge, i));
    at_edges += std::ranges::any_of(edge.hits, [](const BagHit& h) { return std::fabs(h.t - 1) < 0x1p-16; });
  }
  EXPECT_GT(at_vertices, 20u);
  EXPECT_GT(at_edges, 480u);
}

TEST(ShotlineGrid, CoversTheMeshFromInFront) {
  const Mesh mesh = sphere(320);
  const Scene scene(to_bag(mesh).triangles);
  for (const auto& [azimuth, elevation] :
       {std::pair(0.0, 0.0), {90.0, 0.0}, {-90.0, 0.0}, {180.0, 90.0}, {30.0, 60.0}}) {
    const ShotlineGrid grid(mesh, azimuth, elevation, 0.125);
    EXPECT_GE(grid.size(), 15u * 15u);
    EXPECT_LE(grid.size(), 17u * 17u);
    double area = 0;
    for (std::uint64_t i = 0; i < grid.size(); ++i) {
      const BagTruth truth = scene.truth(grid.ray(i));
      ASSERT_EQ(*truth.crossings() % 2, 0u);  // none starts inside
      area += truth.hits.empty() ? 0 : 0.125 * 0.125;
    }
    EXPECT_NEAR(area, 3.14, 0.2);  // of the sphere's shadow
  }
  const Ray ray = ShotlineGrid(mesh, 90, 0, 0.25).ray(0);
  EXPECT_EQ(ray.direction, (Vec3{0, -1, 0}));
}

TEST(ShotlineGrid, HasNoMoreCellsThanItTakesAndIsCentred) {
  Mesh square;  // of size 1, in the plane x = 0
  square.vertices = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(ShotlineGrid(square, 0, 0, 0.5).size(), 4u);
  EXPECT_EQ(ShotlineGrid(square, 0, 0, 0.25).size(), 16u);
  const Ray first = ShotlineGrid(square, 0, 0, 0.5).ray(0);
  EXPECT_EQ(first.origin, (Vec3{1, 0.25, 0.25}));
  EXPECT_EQ(first.direction, (Vec3{-1, 0, 0}));
  const ShotlineGrid coarse(square, 0, 0, 10);
  ASSERT_EQ(coarse.size(), 1u);
  EXPECT_EQ(coarse.ray(0).origin, (Vec3{10, 0.5, 0.5}));
  EXPECT_EQ(ShotlineGrid(square, 90, 0, 0.5).size(), 2u);  // seen from the edge
}

TEST(ShotlineGrid, RefusesCellsThatMakeNoGrid) {
  const Mesh mesh = sphere(80);
  for (const double cell : {0.0, -1.0, double{NAN}, double{INFINITY}, 1e-9})
    EXPECT_THROW(ShotlineGrid(mesh, 0, 0, cell), InputError);
  EXPECT_THROW(ShotlineGrid(mesh, NAN, 0, 1), InputError);
}

}  // namespace
}  // namespace plumbline
