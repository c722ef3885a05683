#include "findings/case_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>
#include <utility>

#include "analysis/ask.h"
#include "analysis/examine.h"
#include "analysis/shrink.h"
#include "analysis/tracers.h"
#include "case/case_files.h"
#include "case/case_text.h"
#include "case/input_error.h"
#include "findings/found.h"
#include "findings/utc.h"

namespace plumbline {
namespace {

// Of one triangle.
std::optional<FoundFinding> found_in(const Tracer& tracer, Case put) {
  const Examination e = Examiner(tracer).examine(put.bag.triangles.front(), put.ray);
  const auto s = signature(e, put.aim ? put.aim->wish : Wish::none);
  if (!s) return std::nullopt;
  const auto input = from_case(put, Space::ray, put.precision);
  FoundFinding f;
  f.signature = to_word(*s);
  f.kind = s->kind;
  f.element = s->element;
  f.conditioning = s->conditioning;
  f.found = {.ulps = finding_ulps(e, *s), .bits = input ? significant_bits(*input) : 0, .what = std::move(put)};
  return f;
}

// The case, put at the tracer's precision.
void add(CaseRows& into, std::map<std::pair<std::string, std::string>, std::size_t>& places, const Tracer& tracer,
         Case put, const std::string& seen) {
  auto finding = put.bag.triangles.size() == 1 ? found_in(tracer, std::move(put)) : ask_for_finding(tracer, put, "");
  if (!finding) {
    ++into.right;
    return;
  }
  FoundCase& found = finding->found;
  const std::string &who = tracer.info().name, &word = finding->signature;
  const auto [place, added] = places.emplace(std::pair(who, word), into.rows.size());
  if (added) {
    FindingRow row;
    row.id = static_cast<std::int64_t>(into.rows.size()) + 1;
    row.tracer = who;
    row.signature = word;
    row.kind = finding->kind;
    row.element = finding->element;
    row.conditioning = finding->conditioning;
    row.worst = row.simplest = found;
    row.first_seen = row.last_seen = seen;
    into.rows.push_back(std::move(row));
  }
  FindingRow& row = into.rows[place->second];
  ++row.count;
  row.first_seen = std::min(row.first_seen, seen);
  row.last_seen = std::max(row.last_seen, seen);
  if (found.bits < row.simplest.bits) row.simplest = found;
  if (found.ulps > row.worst.ulps) row.worst = std::move(found);
}

}  // namespace

CaseRows rows_of_cases(const std::vector<CasePath>& paths) {
  CaseRows all;
  std::map<std::pair<std::string, std::string>, std::size_t> places;
  for (const CasePath& from : paths) {
    for (const std::string& file : case_files(from.path)) {
      const std::string seen = time_of(file);
      for (const Case& c : read_cases(file)) {
        std::set<std::string> names;
        for (const Known& known : c.known) names.insert(known.tracer);
        if (!from.tracer.empty()) names.insert(from.tracer);
        for (const std::string& name : names) {
          const Tracer* const tracer = tracer_named(name);
          if (!tracer) {
            ++all.unknown[name];
            continue;
          }
          Case put = put_at(c, tracer->info().contract.precision);
          put.precision = tracer->info().contract.precision;
          add(all, places, *tracer, std::move(put), seen);
        }
      }
    }
  }
  return all;
}

std::string time_of(const std::string& file) {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file, error);
  if (error) return "";
  const auto utc = std::chrono::file_clock::to_sys(written);
  return utc_text(std::chrono::time_point_cast<std::chrono::system_clock::duration>(utc));
}

}  // namespace plumbline
