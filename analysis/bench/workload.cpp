#include "analysis/bench/workload.h"

#include "analysis/bench/rivals/rivals.h"

namespace plumbline {
namespace {

constexpr std::array<WorkloadPlan, 16> plans = {{
    {.name = "random", .unpaired = true},
    {.name = "random_hits", .hits_only = true},
    {.name = "random_memory", .unpaired = true, .from_memory = true},
    {.name = "small_far", .family = Family::small_far},
    {.name = "lattice", .family = Family::lattice_points, .unpaired = true},
    {.name = "exact_edge12", .family = Family::exact_edge12},
    {.name = "exact_edge23", .family = Family::exact_edge23},
    {.name = "exact_edge51", .family = Family::exact_edge51},
    {.name = "ulp12", .family = Family::ulp12},
    {.name = "ulp51", .family = Family::ulp51},
    {.name = "coplanar", .family = Family::coplanar},
    {.name = "degenerate", .family = Family::degenerate},
    {.name = "mixed40", .family = Family::mixed40},
    {.name = "wide", .family = Family::wide, .unpaired = true},
    {.name = "wide_edge", .family = Family::wide_edge},
    {.name = "full_range", .family = Family::full_range, .unpaired = true},
}};

}  // namespace

std::span<const WorkloadPlan> workload_plans() { return plans; }

JudgedShots draw_judged(const WorkloadPlan& plan, std::uint64_t seed, std::size_t size, double t_max) {
  JudgedShots judged;
  for (std::uint64_t index = 0; judged.shots.size() < size; ++index) {
    Shot shot = draw(plan.family, seed, index);
    shot.ray.t_min = 0;
    shot.ray.t_max = t_max;
    const Truth truth = ask_mpq(shot.triangle, shot.ray);
    if (plan.hits_only && !crosses(truth)) continue;
    judged.shots.push_back(shot);
    judged.truths.push_back(truth);
  }
  return judged;
}

JudgedShots with_triangle(const JudgedShots& judged, const Triangle& triangle) {
  JudgedShots same;
  for (const Shot& shot : judged.shots) {
    same.shots.push_back({triangle, shot.ray});
    same.truths.push_back(ask_mpq(triangle, shot.ray));
  }
  return same;
}

Columns::Columns(const std::vector<Shot>& shots)
    : size_(shots.size()), lines_between_((size_ + 7) / 8 + 5), lines_(17 * lines_between_) {
  for (std::size_t i = 0; i < size_; ++i) {
    const auto& [t, r] = shots[i];
    const std::array<double, 17> row = {t.a.x,         t.a.y,         t.a.z,         t.b.x,      t.b.y,      t.b.z,
                                        t.c.x,         t.c.y,         t.c.z,         r.origin.x, r.origin.y, r.origin.z,
                                        r.direction.x, r.direction.y, r.direction.z, r.t_min,    r.t_max};
    for (std::size_t k = 0; k < row.size(); ++k) lines_[k * lines_between_ + i / 8].value[i % 8] = row[k];
  }
}

Batch Columns::batch() const {
  Batch batch{.size = size_};
  for (std::size_t k = 0; k < 9; ++k) batch.triangle[k] = column(k);
  for (std::size_t k = 0; k < 8; ++k) batch.ray[k] = column(9 + k);
  return batch;
}

}  // namespace plumbline
