// The cases of one benchmark, with their truths by mpq_class, one by one and in columns.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "case/hard_families.h"
#include "oracle/batch.h"
#include "oracle/truth.h"

namespace plumbline {

struct JudgedShots {
  std::vector<Shot> shots;
  std::vector<Truth> truths;
};

struct WorkloadPlan {
  std::string_view name;
  Family family = Family::random;
  bool hits_only = false;     ///< rays that cross the triangle within their range, drawn from the family
  bool unpaired = false;      ///< triangle and ray are drawn apart: one triangle may stand for all
  bool from_memory = false;   ///< too many for any cache
};

/// random, random_hits, random_memory, and the other families by their names.
std::span<const WorkloadPlan> workload_plans();

/// `size` cases, the range of each ray is [0, t_max]. Rays are aimed at t = 1 where a family aims them.
JudgedShots draw_judged(const WorkloadPlan& plan, std::uint64_t seed, std::size_t size, double t_max);

/// All shots with this triangle.
JudgedShots with_triangle(const JudgedShots& judged, const Triangle& triangle);

/// The cases as structure of arrays. Columns begin at cache lines, and the lengths between them keep equal positions of
/// different columns out of each other's cache sets.
class Columns {
 public:
  explicit Columns(const std::vector<Shot>& shots);
  /// Without truths.
  Batch batch() const;

 private:
  struct alignas(64) Line { std::array<double, 8> value; };
  const double* column(std::size_t k) const { return lines_[k * lines_between_].value.data(); }

  std::size_t size_, lines_between_;
  std::vector<Line> lines_;
};

}  // namespace plumbline
