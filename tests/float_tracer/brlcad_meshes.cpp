#include "tests/float_tracer/brlcad_meshes.h"

#include <array>
#include <cmath>

namespace plumbline {
namespace {

Vec3 scaled(double s, const Vec3& v) { return {s * v.x, s * v.y, s * v.z}; }
Vec3 sum(const Vec3& v, const Vec3& w) { return {v.x + w.x, v.y + w.y, v.z + w.z}; }
Vec3 difference(const Vec3& v, const Vec3& w) { return {v.x - w.x, v.y - w.y, v.z - w.z}; }
Vec3 cross(const Vec3& v, const Vec3& w) {
  return {v.y * w.z - v.z * w.y, v.z * w.x - v.x * w.z, v.x * w.y - v.y * w.x};
}
double dot(const Vec3& v, const Vec3& w) { return v.x * w.x + v.y * w.y + v.z * w.z; }
Vec3 unit(const Vec3& v) { return scaled(1 / std::sqrt(dot(v, v)), v); }

// Triangles around a common first vertex; the last closes the ring or doesn't.
std::vector<Triangle> fan(std::size_t blades, bool closed, Random& random) {
  const Vec3 hub = scaled(0.3, random.vector());
  std::vector<Vec3> rim;
  for (std::size_t i = 0; i < blades + !closed; ++i) {
    const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(blades + !closed);
    rim.push_back({std::cos(angle), std::sin(angle), random.within(-0.3, 0.3)});
  }
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < blades; ++i) triangles.push_back({hub, rim[i], rim[(i + 1) % rim.size()]});
  return triangles;
}

std::vector<Triangle> sheets(std::size_t count, double gap) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = static_cast<double>(i) * gap;
    triangles.push_back({{-1, -1, z}, {1, -1, z}, {-1, 1, z}});
    if (i % 3 == 1) std::swap(triangles.back().b, triangles.back().c);
  }
  return triangles;
}

std::vector<Triangle> soup(std::size_t count, Random& random) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < count; ++i) triangles.push_back({random.vector(), random.vector(), random.vector()});
  return triangles;
}

// The top and the bottom of a block, in squares.
std::vector<Triangle> grid(int n) {
  std::vector<Triangle> triangles;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (const double z : {-1.0, 1.0}) {
        const double step = 2.0 / n, x0 = -1 + x * step, y0 = -1 + y * step, x1 = x0 + step, y1 = y0 + step;
        const Vec3 a{x0, y0, z}, b{x1, y0, z}, c{x1, y1, z}, d{x0, y1, z};
        if (z > 0) {
          triangles.push_back({a, b, c}), triangles.push_back({a, c, d});
        } else {
          triangles.push_back({a, c, b}), triangles.push_back({a, d, c});
        }
      }
  return triangles;
}

std::vector<Triangle> shape(std::size_t kind, Random& random, std::string& name) {
  switch (kind) {
    case 0:
      name = "pair";
      return fan(2, false, random);
    case 1:
      name = "fan";
      return fan(3 + random.below(10), random.below(2) == 0, random);
    case 2:
      name = "tetrahedron";
      return tetrahedron();
    case 3:
      name = "cube";
      return cube();
    case 4:
      name = "icosahedron";
      return icosphere(0);
    case 5:
      name = "icosphere 80";
      return icosphere(1);
    case 6:
      name = "icosphere 320";
      return icosphere(2);
    case 7:
      name = "few sheets";
      return sheets(2 + random.below(8), random.below(2) == 0 ? 0.25 : 0.0001);
    case 8:
      name = "many sheets";
      return sheets(33 + random.below(30), random.below(2) == 0 ? 0.05 : 0.0001);
    case 9:
      name = "little soup";
      return soup(2 + random.below(31), random);
    case 10:
      name = "much soup";
      return soup(33 + random.below(100), random);
    default:
      name = "grid";
      return grid(3 + static_cast<int>(random.below(4)));
  }
}

}  // namespace

std::vector<Triangle> tetrahedron() {
  const Vec3 a{1, 1, 1}, b{-1, -1, 1}, c{-1, 1, -1}, d{1, -1, -1};
  return {{a, c, b}, {a, b, d}, {a, d, c}, {b, c, d}};
}

std::vector<Triangle> cube() {
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](double u, double v) {
        std::array<double, 3> p{};
        p[axis] = side, p[(axis + 1) % 3] = u, p[(axis + 2) % 3] = v;
        return Vec3{p[0], p[1], p[2]};
      };
      const Vec3 a = corner(-1, -1), b = corner(side, -side), c = corner(1, 1), d = corner(-side, side);
      triangles.push_back({a, b, c}), triangles.push_back({a, c, d});
    }
  return triangles;
}

std::vector<Triangle> icosphere(int depth) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::array<Vec3, 12> v{{{-1, g, 0},
                                {1, g, 0},
                                {-1, -g, 0},
                                {1, -g, 0},
                                {0, -1, g},
                                {0, 1, g},
                                {0, -1, -g},
                                {0, 1, -g},
                                {g, 0, -1},
                                {g, 0, 1},
                                {-g, 0, -1},
                                {-g, 0, 1}}};
  constexpr std::array<std::array<int, 3>, 20> faces{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  std::vector<Triangle> triangles;
  for (const auto& [i, j, k] : faces)
    triangles.push_back({unit(v[static_cast<std::size_t>(i)]), unit(v[static_cast<std::size_t>(j)]),
                         unit(v[static_cast<std::size_t>(k)])});
  for (; depth > 0; --depth) {
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const Vec3 ab = unit(sum(a, b)), bc = unit(sum(b, c)), ca = unit(sum(c, a));
      for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) finer.push_back(t);
    }
    triangles = std::move(finer);
  }
  return triangles;
}

BrlcadMesh brlcad_mesh(std::size_t kind, Random& random) {
  BrlcadMesh mesh;
  mesh.triangles = shape(kind, random, mesh.kind);
  const double size = std::ldexp(1, static_cast<int>(random.below(14)) - 4);
  const Vec3 place = scaled(random.below(4) == 0 ? 1000 : 4, random.vector());
  const bool on_grid = random.below(2) == 0;
  for (Triangle& t : mesh.triangles)
    for (Vec3* v : {&t.a, &t.b, &t.c}) {
      *v = sum(place, scaled(size, *v));
      if (on_grid) *v = {std::round(v->x * 2) / 2, std::round(v->y * 2) / 2, std::round(v->z * 2) / 2};
    }
  return mesh;
}

std::vector<Bag> brlcad_bags(const std::vector<Triangle>& triangles) {
  std::vector<Bag> bags;
  for (const Orientation orientation : {Orientation::none, Orientation::ccw, Orientation::cw})
    for (const BagMode mode : {BagMode::surface, BagMode::solid})
      bags.push_back({.triangles = triangles, .mode = mode, .orientation = orientation});
  for (const double thickness : {0.1, 0.0, 0.0004, 9.0})
    for (const PlatePosition position : {PlatePosition::centred, PlatePosition::appended})
      for (const bool cosine : {true, false})
        bags.push_back({.triangles = triangles,
                        .mode = BagMode::plate,
                        .thickness = thickness,
                        .position = position,
                        .cosine = cosine,
                        .orientation = thickness == 0.1 ? Orientation::none : Orientation::cw});
  return bags;
}

Ray brlcad_ray(const std::vector<Triangle>& triangles, Random& random) {
  const Triangle& t = triangles[random.below(triangles.size())];
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
  switch (random.below(6)) {
    case 0:
      direction = normal;
      break;
    case 1:
    case 2:
      direction = std::array<Vec3, 3>{{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}[random.below(3)];
      break;
    case 3:  // nearly in the plane
      direction = sum(
          scaled(random.within(-1, 1), ab),
          sum(scaled(random.within(-1, 1), ac), scaled(std::ldexp(1, -static_cast<int>(random.below(40))), normal)));
      break;
    case 4:
      direction = difference(triangles[random.below(triangles.size())].c, target);
      break;
    default:
      break;
  }
  if (!(dot(direction, direction) > 0x1p-100)) direction = random.vector();  // the face is a line or a point
  if (random.below(4) != 0) direction = unit(direction);
  const double standoff = std::array<double, 6>{5, 0.3, 0, -0.2, 1000, random.within(-3, 30)}[random.below(6)];
  return {.origin = difference(target, scaled(standoff, direction)), .direction = direction};
}

}  // namespace plumbline
