#include "tests/float_tracer/brlcad_agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "case/float_bits.h"
#include "case/hard_families.h"
#include "case/lattice.h"
#include "case/targets.h"
#include "float_tracer/adapters/brlcad.h"
#include "tests/float_tracer/brlcad_meshes.h"
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

std::string text(bool answered, const std::vector<Passage>& passages) {
  if (!answered) return "fault";
  if (passages.empty()) return "miss";
  std::string all;
  std::array<char, 120> buffer;
  for (const Passage& p : passages) {
    std::snprintf(buffer.data(), buffer.size(), "%sin %a of %u, out %a of %u", all.empty() ? "" : "; ", p.in,
                  p.triangle_in, p.out, p.triangle_out);
    all += buffer.data();
  }
  return all;
}

std::string text(const Bag& bag) {
  std::string all = std::string(name(bag.mode)) + ", orientation " + std::string(name(bag.orientation)) +
                    ", thickness " + std::to_string(bag.thickness) + " " + std::string(name(bag.position)) +
                    (bag.cosine ? "" : ", no cosine");
  for (const Triangle& t : bag.triangles) all += "\n  triangle " + text(t.a) + "   " + text(t.b) + "   " + text(t.c);
  return all;
}

bool same(const std::vector<Passage>& x, const std::vector<Passage>& y) {
  return std::ranges::equal(x, y, [](const Passage& p, const Passage& q) {
    return to_bits(p.in) == to_bits(q.in) && to_bits(p.out) == to_bits(q.out) && p.triangle_in == q.triangle_in &&
           p.triangle_out == q.triangle_out;
  });
}

Triangle any_triangle(Random& random) {
  const double size = std::ldexp(1, static_cast<int>(random.below(18)) - 8);  // faces of 2^-6 and less are dropped
  const double place = random.below(4) == 0 ? 1000 : 4;
  const Vec3 centre = random.vector();
  const bool on_grid = random.below(2) == 0;
  const auto vertex = [&] {
    const Vec3 w = random.vector();
    const Vec3 v{place * centre.x + size * w.x, place * centre.y + size * w.y, place * centre.z + size * w.z};
    if (!on_grid) return v;
    return Vec3{std::round(v.x * 2) / 2, std::round(v.y * 2) / 2, std::round(v.z * 2) / 2};
  };
  return {vertex(), vertex(), vertex()};
}

}  // namespace

void BrlcadAgreement::compare(const Bag& bag, std::span<const Ray> rays) {
  static const auto adapter = brlcad_tracers();  // as tracer_named has it, in a child, it tells no passages
  const auto real = adapter.front()->prepare(bag), ours = tracer_named("brlcad_bot_classic").prepare(bag);
  std::vector<Answer> theirs(rays.size()), classic(rays.size());
  ours->trace(rays, classic);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ++rays_;
    if (classic[i].outcome == Outcome::fault) {  // not to be asked: there are rays that the real one hangs of
      ++beyond_;
      continue;
    }
    real->trace(rays.subspan(i, 1), {&theirs[i], 1});
    std::vector<Passage> of_real, of_ours;
    const bool answered = real->passages(rays[i], of_real);
    ours->passages(rays[i], of_ours);
    hits_ += !of_real.empty();
    partitions_ += of_real.size();
    if (answered && same(theirs[i], classic[i]) && same(of_real, of_ours)) continue;
    if (++differences_ > 20) continue;
    ADD_FAILURE() << text(bag) << "\n  ray " << text(rays[i].origin) << "   " << text(rays[i].direction)
                  << "\n  the real one: " << text(answered, of_real) << "\n  classic:      " << text(true, of_ours);
  }
}

void BrlcadAgreement::compare_families(std::uint64_t seed, std::uint64_t count) {
  for (std::size_t family = 0; family < family_names.size(); ++family)
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto [triangle, ray] = draw(static_cast<Family>(family), seed, i);
      const std::vector<Bag> bags = brlcad_bags({triangle});
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
    const std::vector<Bag> bags = brlcad_bags({triangle});
    compare(bags[bag++ % bags.size()], rays);
  }
}

void BrlcadAgreement::compare_aimed(std::uint64_t seed, std::uint64_t count) {
  Random random(seed);
  std::array<Ray, 20> rays;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Triangle triangle = any_triangle(random);
    for (Ray& ray : rays) ray = brlcad_ray({triangle}, random);
    const std::vector<Bag> bags = brlcad_bags({triangle});
    compare(bags[i % bags.size()], rays);
  }
}

void BrlcadAgreement::compare_meshes(std::uint64_t seed, std::uint64_t count) {
  Random random(seed);
  std::array<Ray, 20> rays;
  for (std::uint64_t i = 0; i < count; ++i) {
    const BrlcadMesh mesh = brlcad_mesh(i % brlcad_mesh_kinds, random);
    for (Ray& ray : rays) ray = brlcad_ray(mesh.triangles, random);
    const std::vector<Bag> bags = brlcad_bags(mesh.triangles);
    compare(bags[i / brlcad_mesh_kinds % bags.size()], rays);
  }
}

}  // namespace plumbline
