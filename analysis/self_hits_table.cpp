#include "analysis/self_hits_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/csv.h"
#include "analysis/text_table.h"
#include "case/real_text.h"

namespace plumbline {
namespace {

std::string values(const Spread& s) {
  if (s.count == 0) return ",,";
  return fmt::format("{},{},{}", shortest_decimal(s.median), shortest_decimal(s.p99), shortest_decimal(s.worst));
}

std::string share(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "-";
  return part == 0 ? "." : fmt::format("{:.2f}", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

// As a power of two from a million on, rounded up: as many are certainly enough.
std::string ulps(double k) {
  if (std::isinf(k)) return "inf";
  return k < 1e6 ? fmt::format("{:.0f}", k) : fmt::format("2^{:.0f}", std::ceil(std::log2(k)));
}

// The counts of some cells.
struct Sum {
  std::uint64_t rays = 0, beyond = 0, start = 0, beyond_hits = 0, start_hits = 0, false_hits = 0;
  void add(const SelfHitCell& c) {
    rays += c.rays, beyond += c.beyond, start += c.start;
    beyond_hits += c.beyond_hits, start_hits += c.start_hits, false_hits += c.false_hits;
  }
};

TextTable faults_table(const SelfHitResult& result) {
  TextTable table{{{"tracer"},
                   {"point"},
                   {"rays", true},
                   {"behind %", true},
                   {"on %", true},
                   {"false %", true},
                   {"behind hit %", true},
                   {"on hit %", true}},
                  {}};
  for (std::size_t t = 0; t < result.plan.tracers.size(); ++t)
    for (std::size_t p = 0; p < hit_point_names.size(); ++p) {
      Sum all;
      for (const SelfHitScore& score : result.scores[t])
        for (const SelfHitCell& c : score.cells[p]) all.add(c);
      if (all.rays == 0) continue;
      table.rows.push_back({result.plan.tracers[t]->info().name, std::string(hit_point_names[p]),
                            fmt::format("{}", all.rays), share(all.beyond, all.rays), share(all.start, all.rays),
                            share(all.false_hits, all.rays - all.beyond - all.start),
                            share(all.beyond_hits, all.beyond), share(all.start_hits, all.start)});
    }
  return table;
}

// Of some cells that of which the tracer needs most.
std::string most(const std::vector<const SelfHitCell*>& cells, Remedy remedy) {
  const NeedSpread* most = nullptr;
  for (const SelfHitCell* c : cells) {
    const NeedSpread& need = c->need[static_cast<std::size_t>(remedy)];
    if (need.tracer.count > 0 && (!most || need.tracer.p99 > most->tracer.p99)) most = &need;
  }
  return most ? fmt::format("{}/{}", ulps(most->tracer.p99), ulps(most->exact.p99)) : "-";
}

// A line for each tracer and each of `kinds`, which is what the table tells apart: of a score, `cells_of` finds the
// cells of the kind of that index. Lines without a figure are left out.
template <std::size_t Count, class CellsOf>
TextTable needs_table(const SelfHitResult& result, Remedy remedy, std::string title,
                      const std::array<std::string_view, Count>& kinds, CellsOf cells_of) {
  TextTable table{{{"tracer"}, {std::move(title)}}, {}};
  for (const SelfHitFamily& family : result.plan.families) table.columns.push_back({std::string(family.name), true});
  for (std::size_t t = 0; t < result.plan.tracers.size(); ++t)
    for (std::size_t kind = 0; kind < Count; ++kind) {
      std::vector<std::string> row = {result.plan.tracers[t]->info().name, std::string(kinds[kind])};
      for (const SelfHitScore& score : result.scores[t]) row.push_back(most(cells_of(score, kind), remedy));
      if (std::any_of(row.begin() + 2, row.end(), [](const std::string& cell) { return cell != "-"; }))
        table.rows.push_back(std::move(row));
    }
  return table;
}

TextTable origin_table(const SelfHitResult& result) {
  return needs_table(result, Remedy::origin, "point", hit_point_names, [](const SelfHitScore& s, std::size_t point) {
    std::vector<const SelfHitCell*> cells;
    for (const SelfHitCell& c : s.cells[point]) cells.push_back(&c);
    return cells;
  });
}

TextTable t_min_table(const SelfHitResult& result) {
  return needs_table(result, Remedy::t_min, "leaving", leaving_names, [](const SelfHitScore& s, std::size_t leaving) {
    std::vector<const SelfHitCell*> cells;
    for (const auto& by_leaving : s.cells) cells.push_back(&by_leaving[leaving]);
    return cells;
  });
}

}  // namespace

std::string self_hits_csv(const SelfHitResult& result) {
  std::string out =
      "tracer,precision,family,hits,misses,faults,not_finite,point,leaving,rays,beyond,start,beyond_hits,start_hits,"
      "false_hits";
  for (const std::string_view remedy : remedy_names) {
    for (const char* whose : {"tracer", "exact", "excess"})
      out += fmt::format(",{0}_{1}_median,{0}_{1}_p99,{0}_{1}_worst", remedy, whose);
    out += fmt::format(",{0}_nothing,{0}_never", remedy);
  }
  out += '\n';
  for (std::size_t t = 0; t < result.plan.tracers.size(); ++t)
    for (std::size_t f = 0; f < result.plan.families.size(); ++f) {
      const SelfHitScore& s = result.scores[t][f];
      const TracerInfo& info = result.plan.tracers[t]->info();
      for (std::size_t p = 0; p < hit_point_names.size(); ++p)
        for (std::size_t l = 0; l < leaving_names.size(); ++l) {
          const SelfHitCell& c = s.cells[p][l];
          if (c.rays == 0) continue;
          out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", csv_field(info.name),
                             name(info.contract.precision), result.plan.families[f].name, s.hits, s.misses, s.faults,
                             s.not_finite, hit_point_names[p], leaving_names[l], c.rays, c.beyond, c.start,
                             c.beyond_hits, c.start_hits, c.false_hits);
          for (const NeedSpread& n : c.need) {
            for (const Spread* spread : {&n.tracer, &n.exact, &n.excess}) out += ',' + values(*spread);
            out += fmt::format(",{},{}", n.nothing, n.never);
          }
          out += '\n';
        }
    }
  return out;
}

std::string to_terminal(const SelfHitResult& result) {
  std::string out = to_terminal(faults_table(result));
  out += "\nulps that the origin has to move, 99 % of rays, steep or grazing: tracer/exact\n\n";
  out += to_terminal(origin_table(result));
  const TextTable later = t_min_table(result);
  if (later.rows.empty()) return out;
  out += "\nulps of the first ray's t that t_min has to be, 99 % of rays, from any point: tracer/exact\n\n";
  return out + to_terminal(later);
}

}  // namespace plumbline
