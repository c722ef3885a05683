#include "findings/promotion.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "analysis/bag_shrink.h"
#include "analysis/found_case.h"
#include "analysis/shrink.h"
#include "case/case_text.h"
#include "case/folder.h"
#include "case/input_error.h"
#include "case/printable.h"
#include "findings/found.h"
#include "float_tracer/plugin.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

bool is_safe(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == '.';
}

// FNV-1a.
std::uint32_t hash(std::string_view text) {
  std::uint32_t h = 2166136261u;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 16777619u;
  return h;
}

std::string safe(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string name;
  for (const char c : text.substr(0, longest))
    if (is_safe(c))
      name += c;
    else if (!name.ends_with('-'))
      name += '-';
  if (name.starts_with('.') || name.starts_with('-')) name.erase(0, name.find_first_not_of(".-"));
  return name == text ? name : fmt::format("{}-{:08x}", name, hash(text));
}

// A file that was there, or is made by another process meanwhile, stays: false.
bool write_new(const fs::path& path, const std::string& text) {
  const std::string part = fmt::format("{}.{}.part", path.string(), getpid());
  std::ofstream out(part);
  out << text;
  out.close();
  const bool linked = out && link(part.c_str(), path.c_str()) == 0;
  const int error = errno;
  unlink(part.c_str());
  if (!linked && error != EEXIST)
    throw InputError(fmt::format("{}: can't be written: {}; write elsewhere", path.string(), std::strerror(error)));
  return linked;
}

std::string content(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A case that a row keeps, and what the tracer gets wrong of it now.
struct Kept {
  std::string_view name;
  const Case& what;
  std::optional<FoundFinding> now;
};

std::string told(const Kept& kept) {
  return fmt::format("its {} case {}", kept.name, kept.now ? "otherwise wrong (" + kept.now->signature + ")" : "right");
}

// Of the cases kept, the one that shows the finding still: the worst before the simplest. The same signature comes
// before the same kind, which is all that those share whose answers were read and not asked for (finding_in_answer).
Kept still_shown(const FindingRow& row, const Tracer& tracer) {
  std::array<Kept, 2> kept{{{"worst", row.worst.what, {}}, {"simplest", row.simplest.what, {}}}};
  for (Kept& k : kept) k.now = ask_for_finding(tracer, k.what, "");
  for (Kept& k : kept)
    if (k.now && k.now->signature == row.signature) return k;
  for (Kept& k : kept)
    if (k.now && k.now->kind == row.kind) return k;
  throw InputError(fmt::format(
      "finding {}: {} gets {} and {} now; {}", row.id, printable(row.tracer), told(kept[0]), told(kept[1]),
      kept[0].now || kept[1].now ? "'plumbline triage set' closes it, and a new search lists what is wrong now"
                                 : "'plumbline triage retest' closes what is fixed"));
}

// Of several triangles, of which fewer may be left.
Case shrunk_bag(const Case& what, const Tracer& tracer) {
  const auto shrunk = shrink_bag(what, tracer);
  if (!shrunk) return what;
  Case simple = shrunk->what;
  simple.provenance = what.provenance;
  simple.provenance.push_back(fmt::format(
      "shrunk from {} triangles to {}, from {} to {} significant bits: severity {:.6g} ulps of the largest coordinate, "
      "{}",
      what.bag.triangles.size(), simple.bag.triangles.size(), shrunk->bits_before, shrunk->bits_after,
      shrunk->after.judgement.ulps, to_word(*signature(shrunk->after))));
  return simple;
}

Case shrunk_alone(const Case& what, const Tracer& tracer) {
  const auto input = from_case(what, Space::ray, tracer.info().contract.precision);
  const auto shrunk = input ? shrink(*input, tracer, Keep::nominal) : std::nullopt;
  if (!shrunk) return what;
  Case simple = to_case(shrunk->input);
  simple.provenance = what.provenance;
  const Signature now = *signature(shrunk->after);
  simple.provenance.push_back(
      fmt::format("shrunk from {} to {} significant bits (nominal): {}, {}", shrunk->bits_before, shrunk->bits_after,
                  severity_text(finding_ulps(shrunk->after, now), now.conditioning), to_word(now)));
  return simple;
}

}  // namespace

Case promoted(const FindingRow& row, const Tracer* tracer) {
  if (!tracer) return row.worst.what;
  const Kept kept = still_shown(row, *tracer);
  Case simple = kept.what.bag.triangles.size() > 1 ? shrunk_bag(kept.what, *tracer) : shrunk_alone(kept.what, *tracer);
  set_finding(simple, row.tracer, kept.now->kind);
  return simple;
}

std::string file_stem(const FindingRow& row) { return fmt::format("{}-{}", safe(row.tracer), safe(row.signature)); }

std::string put_in_folder(Case what, const std::string& stem, const std::string& folder) {
  make_folder(folder);
  for (unsigned n = 1;; ++n) {
    what.id = n == 1 ? stem : fmt::format("{}-{}", stem, n);
    const fs::path path = fs::path(folder) / (what.id + ".case");
    const std::string text = to_text(what);
    if (write_new(path, text) || content(path) == text) return path.string();
  }
}

void make_ctest_project(const std::string& folder, const std::string& tracer) {
  make_folder(folder);
  const std::string told = names_plugin(tracer) ? "${CMAKE_CURRENT_SOURCE_DIR}/" + fs::relative(tracer, folder).string()
                                                : tracer;
  const std::string text =
      fmt::format("# cmake -S . -B build && ctest --test-dir build --output-on-failure\n"
                  "# A Plumbline that is not found is named by -DCMAKE_PREFIX_PATH=PREFIX.\n"
                  "cmake_minimum_required(VERSION 3.25)\n"
                  "project(regressions LANGUAGES NONE)\n"
                  "find_package(plumbline REQUIRED)\n"
                  "enable_testing()\n"
                  "plumbline_add_corpus(NAME regressions TRACER \"{}\" NO_FAULTS CASES ${{CMAKE_CURRENT_SOURCE_DIR}})\n",
                  told);
  const fs::path path = fs::path(folder) / "CMakeLists.txt";
  if (!write_new(path, text) && content(path) != text)
    throw InputError(fmt::format("{}: is there, and puts its cases to another tracer, or is not of promote; take another folder",
                                 path.string()));
}

}  // namespace plumbline
