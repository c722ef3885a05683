#include "tests/float_tracer/brlcad_agreement.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "case/float_bits.h"
#include "case/hard_families.h"
#include "case/lattice.h"
#include "case/targets.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

bool same(const Answer& x, const Answer& y) {
  return x.outcome == y.outcome && x.has_t == y.has_t && x.has_uv == y.has_uv && x.has_segment == y.has_segment &&
         x.triangle == y.triangle && to_bits(x.t) == to_bits(y.t) && to_bits(x.in) == to_bits(y.in) &&
         to_bits(x.out) == to_bits(y.out);
}

std::string text(const Vec3& v) {
  std::array<char, 100> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%a %a %a", v.x, v.y, v.z);
  return buffer.data();
}

std::string text(const Answer& answer) {
  if (answer.outcome != Outcome::hit) return answer.outcome == Outcome::miss ? "miss" : "fault";
  std::array<char, 100> buffer;
  std::snprintf(buffer.data(), buffer.size(), "hit, in %a out %a", answer.in, answer.out);
  return buffer.data();
}

std::string text(const Bag& bag) {
  const Triangle& t = bag.triangles.front();
  return std::string(name(bag.mode)) + ", orientation " + std::string(name(bag.orientation)) + ", thickness " +
         std::to_string(bag.thickness) + " " + std::string(name(bag.position)) + (bag.cosine ? "" : ", no cosine") +
         "\n  triangle " + text(t.a) + "   " + text(t.b) + "   " + text(t.c);
}

// The same on every machine, unlike the distributions of the standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  std::uint64_t below(std::uint64_t n) { return bits_() % n; }
  double within(double low, double high) { return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53); }
  Vec3 vector() { return {within(-1, 1), within(-1, 1), within(-1, 1)}; }

 private:
  std::mt19937_64 bits_;
};

Vec3 scaled(double s, const Vec3& v) { return {s * v.x, s * v.y, s * v.z}; }
Vec3 sum(const Vec3& v, const Vec3& w) { return {v.x + w.x, v.y + w.y, v.z + w.z}; }
Vec3 difference(const Vec3& v, const Vec3& w) { return {v.x - w.x, v.y - w.y, v.z - w.z}; }
Vec3 cross(const Vec3& v, const Vec3& w) {
  return {v.y * w.z - v.z * w.y, v.z * w.x - v.x * w.z, v.x * w.y - v.y * w.x};
}
Vec3 unit(const Vec3& v) { return scaled(1 / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z), v); }

Triangle any_triangle(Random& random) {
  const double size = std::ldexp(1, static_cast<int>(random.below(18)) - 8);  // faces of 2^-6 and less are dropped
  const Vec3 place = scaled(random.below(4) == 0 ? 1000 : 4, random.vector());
  const bool on_grid = random.below(2) == 0;
  const auto vertex = [&] {
    const Vec3 v = sum(place, scaled(size, random.vector()));
    if (!on_grid) return v;
    return Vec3{std::round(v.x * 2) / 2, std::round(v.y * 2) / 2, std::round(v.z * 2) / 2};
  };
  return {vertex(), vertex(), vertex()};
}

Ray any_ray(Random& random, const Triangle& t) {
  const Vec3 ab = difference(t.b, t.a), ac = difference(t.c, t.a), normal = cross(ab, ac);
  double u = random.within(0, 1), v = random.within(0, 1 - u);
  switch (random.below(6)) {
    case 0:
      u = 0;
      break;
    case 1:
      v = 0;
      break;
    case 2:
      v = 1 - u;
      break;
    case 3:
      u = static_cast<double>(random.below(2)), v = u == 1 ? 0 : static_cast<double>(random.below(2));
      break;
    default:
      break;
  }
  Vec3 target = sum(t.a, sum(scaled(u, ab), scaled(v, ac)));
  if (random.below(3) == 0) target.x = std::nextafter(target.x, random.within(-1, 1) * 1e300);

  Vec3 direction = random.vector();
  switch (random.below(4)) {
    case 0:
      direction = normal;
      break;
    case 1:
      direction = std::array<Vec3, 3>{{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}[random.below(3)];
      break;
    case 2:  // nearly in the plane
      direction = sum(
          scaled(random.within(-1, 1), ab),
          sum(scaled(random.within(-1, 1), ac), scaled(std::ldexp(1, -static_cast<int>(random.below(40))), normal)));
      break;
    default:
      break;
  }
  if (random.below(4) != 0) direction = unit(direction);
  const double standoff = std::array<double, 6>{5, 0.3, 0, -0.2, 1000, random.within(-3, 30)}[random.below(6)];
  return {.origin = difference(target, scaled(standoff, direction)), .direction = direction};
}

}  // namespace

std::vector<Bag> brlcad_bags(const Triangle& triangle) {
  std::vector<Bag> bags;
  for (const Orientation orientation : {Orientation::none, Orientation::ccw, Orientation::cw})
    for (const BagMode mode : {BagMode::surface, BagMode::solid})
      bags.push_back({.triangles = {triangle}, .mode = mode, .orientation = orientation});
  for (const double thickness : {0.1, 0.0, 0.0004, 9.0})
    for (const PlatePosition position : {PlatePosition::centred, PlatePosition::appended})
      for (const bool cosine : {true, false})
        bags.push_back({.triangles = {triangle},
                        .mode = BagMode::plate,
                        .thickness = thickness,
                        .position = position,
                        .cosine = cosine,
                        .orientation = thickness == 0.1 ? Orientation::none : Orientation::cw});
  return bags;
}

void BrlcadAgreement::compare(const Bag& bag, std::span<const Ray> rays) {
  static const Tracer& real = tracer_named("brlcad_librt");
  static const Tracer& ours = tracer_named("brlcad_bot_classic");
  std::vector<Answer> theirs(rays.size()), classic(rays.size());
  real.prepare(bag)->trace(rays, theirs);
  ours.prepare(bag)->trace(rays, classic);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool answered = theirs[i].outcome != Outcome::fault;
    rays_ += answered;
    hits_ += theirs[i].outcome == Outcome::hit;
    if (same(theirs[i], classic[i])) continue;
    if (answered && classic[i].outcome == Outcome::fault) {
      ++beyond_;
      continue;
    }
    if (++differences_ > 20) continue;
    ADD_FAILURE() << text(bag) << "\n  ray " << text(rays[i].origin) << "   " << text(rays[i].direction)
                  << "\n  the real one: " << text(theirs[i]) << "\n  classic:      " << text(classic[i]);
  }
}

void BrlcadAgreement::compare_families(std::uint64_t seed, std::uint64_t count) {
  for (std::size_t family = 0; family < family_names.size(); ++family)
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto [triangle, ray] = draw(static_cast<Family>(family), seed, i);
      const std::vector<Bag> bags = brlcad_bags(triangle);
      compare(bags[i % bags.size()], {&ray, 1});
    }
}

void BrlcadAgreement::compare_lattice(double offset, double standoff) {
  const Aiming aiming{.standoff = standoff};
  std::vector<Ray> rays(aims(aiming).size());
  const Decimal box = parse_decimal("2", "box"), step = parse_decimal("1.5", "step");
  const LatticeAxis axis{.box = box, .step = step, .offset = parse_decimal(std::to_string(offset), "offset")};
  const Lattice lattice = make_lattice({axis, axis, axis});
  std::size_t bag = 0;
  for (std::uint64_t i = 0; i < triple_count(lattice); ++i) {
    const LatticeTriple triple = triple_at(lattice, i);
    if (collinear(triple)) continue;
    const Triangle triangle = triangle_of(lattice, triple);
    aim_rays(triangle, aiming, rays);
    const std::vector<Bag> bags = brlcad_bags(triangle);
    compare(bags[bag++ % bags.size()], rays);
  }
}

void BrlcadAgreement::compare_aimed(std::uint64_t seed, std::uint64_t count) {
  Random random(seed);
  std::array<Ray, 20> rays;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Triangle triangle = any_triangle(random);
    for (Ray& ray : rays) ray = any_ray(random, triangle);
    const std::vector<Bag> bags = brlcad_bags(triangle);
    compare(bags[i % bags.size()], rays);
  }
}

}  // namespace plumbline
