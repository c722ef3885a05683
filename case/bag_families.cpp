#include "case/bag_families.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "case/float_bits.h"
#include "case/precision.h"
#include "case/random.h"

namespace plumbline {
namespace {

// In units of the grid.
struct Point {
  std::int64_t x = 0, y = 0, z = 0;
  friend auto operator<=>(const Point&, const Point&) = default;
};
Point operator+(const Point& p, const Point& q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
Point operator-(const Point& p, const Point& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
Point operator*(std::int64_t k, const Point& p) { return {k * p.x, k * p.y, k * p.z}; }
Point operator/(const Point& p, std::int64_t k) { return {p.x / k, p.y / k, p.z / k}; }

std::int64_t largest(const Point& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

struct Face {
  std::array<Point, 3> corner;
};

// A bag in its own position: what isn't closed has its front above, towards +z.
struct Shape {
  std::vector<Face> faces;
  std::vector<std::array<Point, 2>> edges;  // to be aimed at
  std::vector<Point> vertices;              // to be aimed at
};

// Twice the area of the projection along z, > 0 where it goes counter-clockwise seen from above. In doubles: what it
// decides need not be exact, and is the same everywhere.
double turn(const Point& a, const Point& b, const Point& c) {
  const auto real = [](std::int64_t k) { return static_cast<double>(k); };
  return real(b.x - a.x) * real(c.y - a.y) - real(b.y - a.y) * real(c.x - a.x);
}

class Drawer {
 public:
  // `quarter`: how many multiples of four units the distance 1 has.
  Drawer(Random& random, std::int64_t quarter) : random_(random), quarter_(quarter) {}

  Shape pair() {
    for (;;) {
      const Point a = flat(quarter_ / 3), b = flat(quarter_ / 3), c = flat(quarter_ / 3);
      Point d = a + b - c + flat(quarter_ / 12);
      d.z = height(quarter_ / 4);
      if (!(turn(a, b, c) > 0 && turn(b, a, d) > 0)) continue;
      return {.faces = {{{a, b, c}}, {{b, a, d}}}, .edges = {{a, b}}, .vertices = {a, b}};
    }
  }

  Shape fan() {
    const auto count = static_cast<std::size_t>(random_.integer(3, 12));
    for (;;) {
      const Point centre = flat(quarter_ / 10);
      std::vector<Point> rim;
      for (std::size_t i = 0; i < count; ++i) rim.push_back(at_hour(i * 12 / count));
      Shape shape{.faces = {}, .edges = {}, .vertices = {centre}};
      bool around = true;
      for (std::size_t i = 0; i < count; ++i) {
        const Point &p = rim[i], &q = rim[(i + 1) % count];
        around = around && turn(centre, p, q) > 0;
        shape.faces.push_back({{centre, p, q}});
        shape.edges.push_back({centre, p});
      }
      if (around) return shape;
    }
  }

  // Along the x axis the points X; the triangles below it have the whole edges X[i] X[i+1], those above it the
  // halves.
  Shape strip() {
    const auto cells = random_.integer(2, 4);
    const std::int64_t eighth = quarter_ / 2;  // the middles of X are to be vertices
    std::vector<Point> x, low, high;
    for (std::int64_t i = 0; i <= cells; ++i) {
      const std::int64_t along =
          -3 * eighth / 4 + i * (3 * eighth / 2) / cells + random_.integer(-eighth / 8, eighth / 8);
      const std::int64_t up = random_.integer(-eighth / 4, eighth / 4);
      x.push_back(8 * Point{along, 0, up});
    }
    const auto beside = [&](std::int64_t i, std::int64_t side) {
      const Point& p = x[static_cast<std::size_t>(i)];
      const std::int64_t away = random_.integer(quarter_ / 4, quarter_), up = height(quarter_ / 4);
      return Point{p.x + 4 * (quarter_ / 8), side * 4 * away, up};
    };
    for (std::int64_t i = 0; i < cells; ++i) {
      low.push_back(beside(i, -1));
      high.push_back(beside(i, 1));
    }
    Shape shape;
    for (std::size_t i = 0; i < low.size(); ++i) {
      const Point middle = (x[i] + x[i + 1]) / 2;
      shape.faces.push_back({{low[i], x[i + 1], x[i]}});
      shape.faces.push_back({{x[i], middle, high[i]}});
      shape.faces.push_back({{middle, x[i + 1], high[i]}});
      shape.edges.push_back({x[i], x[i + 1]});
      shape.edges.push_back({middle, high[i]});
      shape.vertices.push_back(middle);
      if (i + 1 == low.size()) break;
      shape.faces.push_back({{low[i], low[i + 1], x[i + 1]}});
      shape.faces.push_back({{x[i + 1], high[i + 1], high[i]}});
    }
    return shape;
  }

  // An icosahedron, each triangle cut into four, again and again.
  Shape sphere() {
    std::vector<std::array<Vec3, 3>> faces = icosahedron();
    for (int level = quarter_ < 1 << 12 ? 1 : 3; level > 0; --level) {
      std::vector<std::array<Vec3, 3>> finer;
      for (const auto& [a, b, c] : faces) {
        const Vec3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
      }
      faces = std::move(finer);
    }
    // The midpoint of an edge has the same bits from either side: addition commutes.
    std::map<std::array<double, 3>, Point> moved;
    const auto place = [&](const Vec3& v) {
      const auto [it, fresh] = moved.try_emplace({v.x, v.y, v.z});
      if (fresh) it->second = rounded(v, 0.9 + 0.1 * std::abs(random_.unit()));
      return it->second;
    };
    Shape shape;
    for (const auto& [a, b, c] : faces) {
      const Point p = place(a), q = place(b), r = place(c);
      shape.faces.push_back({{p, q, r}});
      for (const auto& [from, to] : {std::pair(p, q), std::pair(q, r), std::pair(r, p)})
        if (from < to) shape.edges.push_back({from, to});
    }
    for (const auto& [v, point] : moved) shape.vertices.push_back(point);
    return shape;
  }

  Shape sheets() {
    const std::int64_t count = random_.integer(3, 8), reach = quarter_ / 2;
    const std::int64_t left = random_.integer(-quarter_, -reach), right = random_.integer(reach, quarter_);
    const std::int64_t back = random_.integer(-quarter_, -reach), front = random_.integer(reach, quarter_);
    std::int64_t up = -quarter_;
    Shape shape;
    for (std::int64_t i = 0; i < count; ++i) {
      up += random_.chance(2) ? 1 : random_.integer(1, quarter_ / 8);
      const std::array<Point, 4> corner = {4 * Point{left, back, up}, 4 * Point{right, back, up},
                                           4 * Point{right, front, up}, 4 * Point{left, front, up}};
      const std::size_t k = random_.below(2);
      const Point &p = corner[k], &q = corner[k + 1], &r = corner[k + 2], &s = corner[(k + 3) % 4];
      shape.faces.push_back({{p, q, r}});
      shape.faces.push_back({{r, s, p}});
      shape.edges.push_back({p, r});
      shape.vertices.insert(shape.vertices.end(), {p, r});
    }
    return shape;
  }

  Shape overlap() {
    const std::int64_t count = random_.integer(2, 5), along_x = random_.integer(-1, 1),
                       along_y = random_.integer(-1, 1);
    const auto in_plane = [&] {
      Point p = flat(quarter_ / 3);
      p.z = along_x * p.x + along_y * p.y;
      return p;
    };
    Shape shape;
    while (static_cast<std::int64_t>(shape.faces.size()) < count) {
      const Point a = in_plane(), b = in_plane(), c = in_plane();
      if (!(turn(a, b, c) > 0)) continue;
      shape.faces.push_back({{a, b, c}});
      if (random_.chance(4)) shape.faces.push_back({{a, b, c}});
      shape.edges.insert(shape.edges.end(), {{a, b}, {b, c}, {c, a}});
      shape.vertices.insert(shape.vertices.end(), {a, b, c});
    }
    return shape;
  }

  // The index's digits: an edge, and two further points.
  Shape lattice(std::uint64_t index) {
    std::vector<Point> points;
    for (int k = 0; k < 27; ++k) points.push_back(4 * quarter_ * Point{k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1});
    const auto take_pair = [&](std::uint64_t which) {
      std::size_t first = 0;
      for (; which >= points.size() - 1 - first; ++first) which -= points.size() - 1 - first;
      const std::size_t second = first + 1 + which;
      const std::array<Point, 2> pair = {points[first], points[second]};
      points.erase(points.begin() + static_cast<std::ptrdiff_t>(second));
      points.erase(points.begin() + static_cast<std::ptrdiff_t>(first));
      return pair;
    };
    index %= lattice_bags;
    const auto [a, b] = take_pair(index / 300);
    const auto [c, d] = take_pair(index % 300);
    return {.faces = {{{a, b, c}}, {{b, a, d}}}, .edges = {{a, b}}, .vertices = {a, b}};
  }

 private:
  std::int64_t height(std::int64_t reach) { return 4 * random_.integer(-reach, reach); }

  Point flat(std::int64_t reach) {
    const std::int64_t x = random_.integer(-reach, reach), y = random_.integer(-reach, reach);
    return {4 * x, 4 * y, height(quarter_ / 4)};
  }

  // A point of a rim, where the hand of a clock points to, by and large.
  Point at_hour(std::size_t hour) {
    constexpr double half_root3 = 0.8660254037844386;
    constexpr std::array<double, 12> cosine = {1,  half_root3,  0.5,  0, -0.5, -half_root3,
                                               -1, -half_root3, -0.5, 0, 0.5,  half_root3};
    const double x = cosine[hour] + 0.2 * random_.unit(), y = cosine[(hour + 9) % 12] + 0.2 * random_.unit();
    Point p = rounded({x, y, 0}, 0.4 + 0.4 * std::abs(random_.unit()));
    p.z = height(quarter_ / 4);
    return p;
  }

  Point rounded(const Vec3& v, double factor) const {
    const auto whole = [&](double x) {
      return 4 * static_cast<std::int64_t>(std::floor(x * factor * static_cast<double>(quarter_) + 0.5));
    };
    return {whole(v.x), whole(v.y), whole(v.z)};
  }

  static Vec3 unit(const Vec3& v) {
    const double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return {v.x / length, v.y / length, v.z / length};
  }
  static Vec3 middle(const Vec3& p, const Vec3& q) { return unit({p.x + q.x, p.y + q.y, p.z + q.z}); }

  static std::vector<std::array<Vec3, 3>> icosahedron() {
    const double golden = (1 + std::sqrt(5.0)) / 2;
    std::vector<Vec3> v;
    for (const double s : {1.0, -1.0})
      for (const double t : {golden, -golden})
        for (const Vec3& p : {Vec3{s, t, 0}, Vec3{0, s, t}, Vec3{t, 0, s}}) v.push_back(unit(p));
    // Its faces are the triples of neighbours; of edge 2 before they were scaled.
    const auto near = [&](std::size_t i, std::size_t j) {
      return v[i].x * v[j].x + v[i].y * v[j].y + v[i].z * v[j].z > 0.4;
    };
    std::vector<std::array<Vec3, 3>> faces;
    for (std::size_t i = 0; i < v.size(); ++i)
      for (std::size_t j = i + 1; j < v.size(); ++j)
        for (std::size_t k = j + 1; k < v.size(); ++k) {
          if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
          const Vec3 &a = v[i], &b = v[j], &c = v[k];
          const double volume =
              a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
          faces.push_back(volume > 0 ? std::array{a, b, c} : std::array{a, c, b});
        }
    return faces;
  }

  Random& random_;
  std::int64_t quarter_;
};

Shape shape_of(BagFamily family, Random& random, std::int64_t quarter, std::uint64_t index) {
  Drawer drawer(random, quarter);
  switch (family) {
    case BagFamily::pair: return drawer.pair();
    case BagFamily::fan: return drawer.fan();
    case BagFamily::strip: return drawer.strip();
    case BagFamily::sphere: return drawer.sphere();
    case BagFamily::sheets: return drawer.sheets();
    case BagFamily::overlap: return drawer.overlap();
    case BagFamily::lattice: return drawer.lattice(index);
  }
  return {};
}

const auto& one_of(const auto& list, Random& random) { return list[random.below(list.size())]; }

struct Target {
  Point at;
  std::vector<Point> around;  // corners of the triangles that it lies on
};

Target target_in(const Shape& shape, BagTarget target, Random& random) {
  if (target == BagTarget::vertex) {
    const Point& p = one_of(shape.vertices, random);
    return {p, {p}};
  }
  if (target == BagTarget::edge) {
    const auto& [p, q] = one_of(shape.edges, random);
    return {p + random.integer(1, 3) * ((q - p) / 4), {p, q}};
  }
  const auto& [a, b, c] = one_of(shape.faces, random).corner;
  return {a + (b - a) / 4 + (c - a) / 4, {}};
}

std::vector<const Face*> faces_around(const Shape& shape, const Target& target) {
  std::vector<const Face*> faces;
  for (const Face& face : shape.faces)
    if (std::ranges::find_first_of(face.corner, target.around) != face.corner.end()) faces.push_back(&face);
  return faces;
}

// Beside the target, in the plane of a triangle around it, or of any; from there a little off.
Point grazing_origin(const Shape& shape, const Target& target, std::int64_t one, Random& random) {
  const auto faces = faces_around(shape, target);
  const auto& [a, b, c] = faces.empty() ? one_of(shape.faces, random).corner : one_of(faces, random)->corner;
  Point along;
  while (along == Point{}) {
    const std::int64_t i = random.integer(-2, 2), j = random.integer(-2, 2);
    along = i * ((b - a) / 4) + j * ((c - a) / 4);
  }
  while (largest(along) < one / 4) along = 2 * along;
  while (largest(along) > one / 2) along = along / 2;
  Point aside;
  *std::array{&aside.x, &aside.y, &aside.z}[random.below(3)] = random.integer(-one / 64, one / 64);
  return target.at + along + aside;
}

// Half-way to the centre of what is closed at most, or beyond what holds the bag.
Point any_origin(BagOrigin where, bool closed, std::int64_t one, Random& random) {
  const std::int64_t reach = closed && where == BagOrigin::inside ? one / 4 : closed ? 2 * one - 1 : one;
  for (;;) {
    const std::int64_t x = random.integer(-reach, reach), y = random.integer(-reach, reach);
    if (!closed) {
      const std::int64_t z = random.integer(one + 1, 2 * one - 1);
      return {x, y, where == BagOrigin::inside ? -z : z};
    }
    const Point p = {x, y, random.integer(-reach, reach)};
    if (where == BagOrigin::inside || largest(p) > one) return p;
  }
}

// On which side of a face, in doubles, as turn().
int side(const Face& face, const Point& p) {
  const auto real = [](const Point& q) {
    return Vec3{static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z)};
  };
  const Vec3 a = real(face.corner[0] - p), b = real(face.corner[1] - p), c = real(face.corner[2] - p);
  const double volume = a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

Point origin_for(const Shape& shape, const Target& target, BagOrigin where, bool closed, std::int64_t one,
                 Random& random) {
  const auto faces = faces_around(shape, target);
  Point origin;
  for (int tries = 0; tries < 64; ++tries) {
    origin = any_origin(where, closed, one, random);
    const auto alike = [&](const Face* face) { return side(*face, origin) == side(*faces.front(), origin); };
    if (std::ranges::all_of(faces, alike)) break;
  }
  return origin;
}

double moved(double x, const BagAim& aim, Random& random) {
  const std::int64_t by = random.integer(-aim.ulps, aim.ulps);
  return is_zero(x) ? x : step_ulps(x, by, aim.precision);
}

}  // namespace

AimedBag draw(BagFamily family, const BagAim& aim, std::size_t rays, std::uint64_t seed, std::uint64_t index) {
  Random random(Random(seed, static_cast<std::uint64_t>(family)).bits(), index);
  const std::int64_t one = std::int64_t{1} << (aim.bits - 2);
  const double unit = 1 / static_cast<double>(one);
  const auto turned = family == BagFamily::lattice ? 0 : random.below(3);  // the axes, so that none is special
  const auto to_vec = [&](const Point& p) {
    const double x = static_cast<double>(p.x) * unit, y = static_cast<double>(p.y) * unit,
                 z = static_cast<double>(p.z) * unit;
    return turned == 0 ? Vec3{x, y, z} : turned == 1 ? Vec3{y, z, x} : Vec3{z, x, y};
  };
  const Shape shape = shape_of(family, random, one / 4, index);
  AimedBag bag{.triangles = {}, .closed = family == BagFamily::sphere, .rays = {}};
  for (const auto& [corner] : shape.faces) {
    const std::size_t first = random.below(3);
    bag.triangles.push_back(
        {to_vec(corner[first]), to_vec(corner[(first + 1) % 3]), to_vec(corner[(first + 2) % 3])});
  }
  for (std::size_t i = 0; i < rays; ++i) {
    const Target target = target_in(shape, aim.target, random);
    const Point origin = aim.origin == BagOrigin::grazing
                             ? grazing_origin(shape, target, one, random)
                             : origin_for(shape, target, aim.origin, bag.closed, one, random);
    Vec3 direction = to_vec(target.at - origin);
    for (double* component : {&direction.x, &direction.y, &direction.z}) *component = moved(*component, aim, random);
    bag.rays.push_back({.origin = to_vec(origin), .direction = direction});
  }
  return bag;
}

}  // namespace plumbline
