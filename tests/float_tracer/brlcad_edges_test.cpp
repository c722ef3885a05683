// How often BRL-CAD's tracers lose closed meshes at edges and vertices, mode by mode: the figures of docs/brlcad.md.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "tests/float_tracer/brlcad_meshes.h"
#include "tests/float_tracer/shoot.h"

namespace plumbline {
namespace {

constexpr std::size_t shots = 20000;
constexpr double radius = 10, standoff = 5;

// Away from whole numbers, so that the nudge of the walk has no part in it.
std::vector<Triangle> sphere(int depth) {
  std::vector<Triangle> triangles = icosphere(depth);
  for (Triangle& t : triangles)
    for (Vec3* v : {&t.a, &t.b, &t.c}) *v = {radius * v->x + 0.3, radius * v->y + 0.4, radius * v->z + 0.35};
  return triangles;
}

// From outside through a vertex, or a point of an edge, into the middle of the sphere; rounded, so some pass beside it.
Ray inwards(const std::vector<Triangle>& triangles, bool at_vertex, Random& random) {
  const Triangle& t = triangles[random.below(triangles.size())];
  const double s = at_vertex ? 0 : random.within(0, 1);
  const Vec3 target{t.a.x + s * (t.b.x - t.a.x), t.a.y + s * (t.b.y - t.a.y), t.a.z + s * (t.b.z - t.a.z)};
  const Vec3 inside = random.vector();
  const Vec3 d{inside.x + 0.3 - target.x, inside.y + 0.4 - target.y, inside.z + 0.35 - target.z};
  const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  const Vec3 u{d.x / length, d.y / length, d.z / length};
  return {.origin = {target.x - standoff * u.x, target.y - standoff * u.y, target.z - standoff * u.z}, .direction = u};
}

struct Losses {
  std::size_t entry = 0;  // nothing begins where the ray enters
  std::size_t other = 0;  // that isn't lost, but what follows isn't what it should be
  friend bool operator==(const Losses&, const Losses&) = default;
};

void PrintTo(const Losses& l, std::ostream* out) { *out << "{" << l.entry << ", " << l.other << "}"; }

Losses losses(const Tracer& tracer, const Bag& bag, bool at_vertex) {
  Random random(20);
  const auto prepared = tracer.prepare(bag);
  const bool apart = bag.mode != BagMode::solid;  // entry and exit are passages each
  Losses lost;
  std::vector<Passage> found;
  for (std::size_t i = 0; i < shots; ++i) {
    EXPECT_TRUE(prepared->passages(inwards(bag.triangles, at_vertex, random), found));
    const double half = bag.mode == BagMode::plate ? bag.thickness : 0;
    if (found.empty() || std::abs(found[0].in - standoff) > half + 0.001)
      ++lost.entry;
    else if (found.size() != (apart ? 2u : 1u) || found.back().out < standoff + radius)
      ++lost.other;
  }
  return lost;
}

struct Row {
  const char* mesh;
  int depth;
  Bag kind;
  std::array<Losses, 2> classic, hlbvh;  // at edges, at vertices
};

TEST(BrlcadEdges, LossesOfClosedMeshes) {
  const Bag surface{}, plate{.triangles = {}, .mode = BagMode::plate, .thickness = 0.1};
  const Bag solid{.triangles = {}, .mode = BagMode::solid};
  Bag oriented = solid;
  oriented.orientation = Orientation::ccw;
  const std::array<Row, 8> rows{{
      {"20 faces", 0, surface, {Losses{264, 0}, {74, 0}}, {Losses{364, 0}, {996, 0}}},
      {"20 faces", 0, plate, {Losses{264, 0}, {74, 0}}, {Losses{364, 0}, {996, 0}}},
      {"20 faces", 0, solid, {Losses{264, 0}, {74, 0}}, {Losses{364, 0}, {996, 0}}},
      {"20 faces", 0, oriented, {Losses{0, 0}, {0, 0}}, {Losses{60, 0}, {25, 0}}},
      {"320 faces", 2, surface, {Losses{863, 0}, {1699, 0}}, {Losses{292, 0}, {1017, 0}}},
      {"320 faces", 2, plate, {Losses{798, 0}, {1724, 0}}, {Losses{292, 0}, {1017, 0}}},
      {"320 faces", 2, solid, {Losses{863, 0}, {1699, 0}}, {Losses{292, 0}, {1017, 0}}},
      {"320 faces", 2, oriented, {Losses{0, 0}, {0, 0}}, {Losses{2, 0}, {0, 0}}},
  }};
  for (const Row& row : rows) {
    Bag bag = row.kind;
    bag.triangles = sphere(row.depth);
    for (const char* name : {"brlcad_bot_classic", "brlcad_bot_hlbvh"}) {
      const Tracer& tracer = tracer_named(name);
      const std::array<Losses, 2> lost{losses(tracer, bag, false), losses(tracer, bag, true)};
      std::printf("%s, %s %s, %s: {{{%zu, %zu}, {%zu, %zu}}}\n", row.mesh, plumbline::name(bag.mode).data(),
                  plumbline::name(bag.orientation).data(), name, lost[0].entry, lost[0].other, lost[1].entry,
                  lost[1].other);
      EXPECT_EQ(lost, name == std::string("brlcad_bot_classic") ? row.classic : row.hlbvh);
    }
  }
}

}  // namespace
}  // namespace plumbline
