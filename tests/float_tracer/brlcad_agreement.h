// What is written here of BRL-CAD against the real library: brlcad_bot_classic and brlcad_librt, bit for bit.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "case/case.h"

namespace plumbline {

/// Around one triangle: every mode, with and without orientation, and every kind of plate.
std::vector<Bag> brlcad_bags(const Triangle& triangle);

/// A difference is a GoogleTest failure that shows bag, ray and answers as hexfloats. A fault of brlcad_bot_classic is
/// none: the bag is beyond what it models.
class BrlcadAgreement {
 public:
  void compare(const Bag& bag, std::span<const Ray> rays);
  /// `count` shots of every hard family, the kind of bag changing with each.
  void compare_families(std::uint64_t seed, std::uint64_t count);
  /// The report's rays at every triangle of the lattice {0, 1.5}^3 + offset, the kind of bag changing with each.
  void compare_lattice(double offset, double standoff);
  /// `count` triangles of all sizes and slopes, half of them on a coarse grid. At each, rays through points of its
  /// interior, edges and vertices, and an ulp beside them: along its normal, an axis, nearly in its plane, or anywhere;
  /// of unit length or not; from before, within and behind.
  void compare_aimed(std::uint64_t seed, std::uint64_t count);

  std::uint64_t rays() const { return rays_; }      ///< that the real library answered
  std::uint64_t hits() const { return hits_; }      ///< of the real library
  std::uint64_t beyond() const { return beyond_; }  ///< that brlcad_bot_classic doesn't model
  std::uint64_t differences() const { return differences_; }

 private:
  std::uint64_t rays_ = 0, hits_ = 0, beyond_ = 0, differences_ = 0;
};

}  // namespace plumbline
