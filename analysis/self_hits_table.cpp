#include "analysis/self_hits_table.h"

#include <fmt/format.h>

#include <algorithm>
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

// A line for each tracer and point that it has somewhere; the cells of a line are the caller's.
template <class CellsOf>
void add_rows(const SelfHitResult& result, TextTable& table, CellsOf cells_of) {
  for (std::size_t t = 0; t < result.plan.tracers.size(); ++t)
    for (std::size_t p = 0; p < hit_point_names.size(); ++p) {
      const auto left = [&](const SelfHitScore& s) {
        return std::ranges::any_of(s.cells[p], [](const SelfHitCell& c) { return c.rays > 0; });
      };
      if (std::ranges::none_of(result.scores[t], left)) continue;
      std::vector<std::string> row = {result.plan.tracers[t]->info().name, std::string(hit_point_names[p])};
      cells_of(result.scores[t], p, row);
      table.rows.push_back(std::move(row));
    }
}

TextTable faults_table(const SelfHitResult& result) {
  TextTable table{{{"tracer"}, {"point"}, {"rays", true}, {"behind %", true}, {"on %", true}, {"false %", true},
                   {"behind hit %", true}, {"on hit %", true}},
                  {}};
  add_rows(result, table, [](const std::vector<SelfHitScore>& scores, std::size_t point, std::vector<std::string>& row) {
    SelfHitCell all;
    for (const SelfHitScore& score : scores)
      for (const SelfHitCell& c : score.cells[point]) {
        all.rays += c.rays, all.beyond += c.beyond, all.start += c.start;
        all.beyond_hits += c.beyond_hits, all.start_hits += c.start_hits, all.false_hits += c.false_hits;
      }
    row.push_back(fmt::format("{}", all.rays));
    row.push_back(share(all.beyond, all.rays));
    row.push_back(share(all.start, all.rays));
    row.push_back(share(all.false_hits, all.rays - all.beyond - all.start));
    row.push_back(share(all.beyond_hits, all.beyond));
    row.push_back(share(all.start_hits, all.start));
  });
  return table;
}

TextTable needs_table(const SelfHitResult& result, Remedy remedy) {
  TextTable table{{{"tracer"}, {"point"}}, {}};
  for (const SelfHitFamily& family : result.plan.families) table.columns.push_back({std::string(family.name), true});
  add_rows(result, table, [&](const std::vector<SelfHitScore>& scores, std::size_t point, std::vector<std::string>& row) {
    for (const SelfHitScore& score : scores) {
      double tracer = 0, exact = 0;
      std::uint64_t count = 0;
      for (const SelfHitCell& c : score.cells[point]) {
        const NeedSpread& need = c.need[static_cast<std::size_t>(remedy)];
        tracer = std::max(tracer, need.tracer.p99);
        exact = std::max(exact, need.exact.p99);
        count += need.tracer.count;
      }
      row.push_back(count > 0 ? fmt::format("{}/{}", ulps(tracer), ulps(exact)) : "-");
    }
  });
  const auto unasked = [](const std::vector<std::string>& row) {
    return std::all_of(row.begin() + 2, row.end(), [](const std::string& cell) { return cell == "-"; });
  };
  std::erase_if(table.rows, unasked);
  return table;
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
  out += "\nulps that the origin has to move, 99 % of rays: tracer/exact\n\n";
  out += to_terminal(needs_table(result, Remedy::origin));
  const TextTable later = needs_table(result, Remedy::t_min);
  if (later.rows.empty()) return out;
  out += "\nulps of the first ray's t that t_min has to be, 99 % of rays: tracer/exact\n\n";
  return out + to_terminal(later);
}

}  // namespace plumbline
