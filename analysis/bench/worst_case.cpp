#include "analysis/bench/worst_case.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <random>

#include "case/float_bits.h"
#include "oracle/classify.h"

namespace plumbline {
namespace {

using Clock = std::chrono::steady_clock;

std::array<double*, 17> values(Shot& s) {
  Triangle& t = s.triangle;
  Ray& r = s.ray;
  return {&t.a.x,         &t.a.y,         &t.a.z,         &t.b.x,      &t.b.y,      &t.b.z,
          &t.c.x,         &t.c.y,         &t.c.z,         &r.origin.x, &r.origin.y, &r.origin.z,
          &r.direction.x, &r.direction.y, &r.direction.z, &r.t_min,    &r.t_max};
}

double least_ns(const Shot& shot, int repetitions) {
  constexpr int calls = 4;
  auto least = Clock::duration::max();
  for (int i = 0; i < repetitions; ++i) {
    const auto begin = Clock::now();
    for (int k = 0; k < calls; ++k) classify(shot.triangle, shot.ray);
    least = std::min(least, Clock::now() - begin);
  }
  return std::chrono::duration<double, std::nano>(least).count() / calls;
}

// One value becomes another finite one.
void mutate(Shot& shot, std::mt19937_64& random) {
  constexpr std::uint64_t exponent = FloatFormat<double>::exponent_mask;
  const auto all = values(shot);
  const std::size_t at = random() % all.size();
  const double was = *all[at];
  const auto mutant = [&] {
    switch (random() % 7) {
      case 0:
        return from_bits<double>(random());
      case 1:
        return from_bits<double>(to_bits(was) ^ std::uint64_t{1} << random() % 64);
      case 2:
        return from_bits<double>((to_bits(was) & ~exponent) | (random() & exponent));
      case 3:
        return *all[random() % all.size()];
      case 4:
        return *all[at % 3 + 3 * (random() % 5)];  // of the same axis: a difference that vanishes
      case 5:
        return step_ulps(was, random() % 2 == 0 ? 1 : -1);
      default:
        return -was;
    }
  };
  do *all[at] = mutant();
  while (!is_finite(*all[at]));
}

}  // namespace

WorstCase search_worst_case(std::uint64_t seed, double seconds) {
  constexpr std::array starts = {Family::full_range, Family::wide,  Family::wide_edge,
                                 Family::mixed40,    Family::ulp51, Family::exact_edge51};
  struct Climber {
    Shot shot;
    double ns;
  };
  std::mt19937_64 random(seed);
  std::vector<Climber> climbers;
  for (const Family family : starts) {
    const Shot shot = draw(family, seed, 0);
    climbers.push_back({shot, least_ns(shot, 50)});
  }
  WorstCase worst;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  for (; Clock::now() < end; ++worst.tried) {
    Climber& climber = climbers[worst.tried % climbers.size()];
    Shot shot = climber.shot;
    for (std::uint64_t left = 1 + random() % 3; left > 0; --left) mutate(shot, random);
    if (least_ns(shot, 3) <= climber.ns) continue;
    const double ns = least_ns(shot, 50);  // once more, so that no accident is kept
    if (ns > climber.ns) climber = {shot, ns};
  }
  for (const Climber& climber : climbers) {
    const double ns = least_ns(climber.shot, 200);
    if (ns > worst.ns) worst.ns = ns, worst.shot = climber.shot;
  }
  return worst;
}

}  // namespace plumbline
