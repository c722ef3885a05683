// A case: what is put to a tracer and to the oracle alike, with where it came from and what its author wished.
// The archival noun. Hot loops use spans of rays against one bag, never a vector of cases.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/geometry.h"
#include "case/hit_class.h"
#include "case/verdict.h"

namespace plumbline {

enum class Precision : unsigned char { binary32, binary64 };
inline constexpr std::array<std::string_view, 2> precision_names = {"binary32", "binary64"};
constexpr std::string_view name(Precision p) { return precision_names[static_cast<unsigned>(p)]; }

/// How the triangles make up an object: each a surface, all together the boundary of a solid, or each a plate.
enum class BagMode : unsigned char { surface, solid, plate };
inline constexpr std::array<std::string_view, 3> bag_mode_names = {"surface", "solid", "plate"};
constexpr std::string_view name(BagMode m) { return bag_mode_names[static_cast<unsigned>(m)]; }

/// Where a plate's material lies: half on each side of the triangle, or all of it behind.
enum class PlatePosition : unsigned char { centred, appended };
inline constexpr std::array<std::string_view, 2> plate_position_names = {"centred", "appended"};
constexpr std::string_view name(PlatePosition p) { return plate_position_names[static_cast<unsigned>(p)]; }

/// Which way round the vertices go, seen from outside.
enum class Orientation : unsigned char { none, ccw, cw };
inline constexpr std::array<std::string_view, 3> orientation_names = {"none", "ccw", "cw"};
constexpr std::string_view name(Orientation o) { return orientation_names[static_cast<unsigned>(o)]; }

/// A bag of triangles.
struct Bag {
  std::vector<Triangle> triangles;
  BagMode mode = BagMode::surface;
  double thickness = 0;                              ///< of a plate, in units of length
  PlatePosition position = PlatePosition::centred;   ///< of a plate
  bool cosine = true;                                ///< of a plate: the ray's way through it is thickness / |cos|
  Orientation orientation = Orientation::none;
  friend bool operator==(const Bag&, const Bag&) = default;
};

/// What the author of a target point wished; no ground truth.
enum class Wish : unsigned char { none, hit, miss };
inline constexpr std::array<std::string_view, 3> wish_names = {"none", "hit", "miss"};
constexpr std::string_view name(Wish w) { return wish_names[static_cast<unsigned>(w)]; }

/// The three kinds of target of the report's table.
enum class TargetKind : unsigned char { interior, vertex_edge, tolerance };
inline constexpr std::array<std::string_view, 3> target_kind_names = {"interior", "vertex_edge", "tolerance"};
constexpr std::string_view name(TargetKind k) { return target_kind_names[static_cast<unsigned>(k)]; }

/// How a ray was aimed. The tolerance is the report's offset of a target from an edge or vertex; nothing else is
/// called so.
struct Aim {
  TargetKind target = TargetKind::interior;
  std::optional<double> tolerance;  ///< for TargetKind::tolerance, in units of length
  double standoff = 0;              ///< from the firing point to the target, in lengths of the direction
  Wish wish = Wish::none;
  friend bool operator==(const Aim&, const Aim&) = default;
};

/// What a .case file says about the truth; re-derived by the oracle in every run, never trusted.
struct Expectation {
  HitClass hit_class = HitClass::invalid;
  Feature feature = Feature::none;
  std::optional<bool> hit;  ///< of the closed triangle within the closed range
  std::optional<double> t, u, v;
  friend bool operator==(const Expectation&, const Expectation&) = default;
};

/// An open finding: this tracer is known to get this case wrong in this way.
struct Known {
  std::string tracer;
  VerdictKind kind = VerdictKind::false_miss;
  friend bool operator==(const Known&, const Known&) = default;
};

struct Case {
  std::string id;
  std::vector<std::string> provenance;  ///< comment lines, without the leading "# "
  Precision precision = Precision::binary64;
  Bag bag;
  Ray ray;
  std::optional<Aim> aim;
  std::optional<Expectation> expect;
  std::vector<Known> known;
  friend bool operator==(const Case&, const Case&) = default;
};

}  // namespace plumbline
