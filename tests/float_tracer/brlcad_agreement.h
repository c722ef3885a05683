// What is written here of BRL-CAD against the real library: brlcad_bot_classic and brlcad_librt, bit for bit.
#pragma once
#include <cstdint>
#include <span>

#include "case/case.h"

namespace plumbline {

/// A difference in any partition is a GoogleTest failure that shows bag, ray and answers as hexfloats. Where
/// brlcad_bot_classic has no answer, the bag or ray is beyond what it models, and the real one isn't asked.
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
  /// `count` bags of several faces, each with 20 rays; the kinds of mesh and of bag change with each.
  void compare_meshes(std::uint64_t seed, std::uint64_t count);

  std::uint64_t rays() const { return rays_; }
  std::uint64_t hits() const { return hits_; }              ///< of the real library
  std::uint64_t partitions() const { return partitions_; }  ///< of the real library
  std::uint64_t beyond() const { return beyond_; }          ///< rays that brlcad_bot_classic doesn't model
  std::uint64_t differences() const { return differences_; }

 private:
  std::uint64_t rays_ = 0, hits_ = 0, partitions_ = 0, beyond_ = 0, differences_ = 0;
};

}  // namespace plumbline
