#include "analysis/scan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <thread>

#include "analysis/bag_shrink.h"
#include "analysis/found_case.h"
#include "analysis/scan_rays.h"
#include "analysis/scan_table.h"
#include "analysis/text_table.h"
#include "case/case_text.h"
#include "case/enum_names.h"
#include "case/folder.h"
#include "case/input_error.h"
#include "cli/findings_option.h"
#include "cli/interruption.h"
#include "cli/number_options.h"
#include "cli/output.h"
#include "cli/scan_folder.h"
#include "cli/tracer_options.h"
#include "cli/verb.h"
#include "findings/collector.h"
#include "findings/found.h"
#include "findings/store.h"
#include "mesh/mesh_report.h"
#include "mesh/read_mesh.h"

namespace plumbline {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  std::string mesh, folder, store;
  std::vector<std::string> tracers, aims;
  std::vector<std::array<double, 3>> views;
  std::uint64_t rays = 1'000'000, seed = 1;
  unsigned jobs = std::max(1u, std::thread::hardware_concurrency());
  bool shrink = true;
  ForeignOptions foreign;
};

std::vector<ScanSet> sets_of(const Options& options, const Mesh& mesh) {
  std::vector<ScanAim> aims;
  for (const std::string& word : options.aims) aims.push_back(*from_name<ScanAim>(scan_aim_names, word));
  if (aims.empty() && options.views.empty())
    for (std::size_t k = 0; k < scan_aim_names.size(); ++k) aims.push_back(static_cast<ScanAim>(k));
  std::vector<ScanSet> sets;
  const auto rays = std::make_shared<ScanRays>(mesh, options.seed);
  for (std::size_t k = 0; k < aims.size(); ++k) {
    // As even as it goes.
    const std::uint64_t size = options.rays * (k + 1) / aims.size() - options.rays * k / aims.size();
    sets.push_back(
        {std::string(name(aims[k])), size, [rays, aim = aims[k]](std::uint64_t i) { return rays->ray(aim, i); }});
  }
  for (const auto& [azimuth, elevation, cell] : options.views) {
    const auto grid = std::make_shared<ShotlineGrid>(mesh, azimuth, elevation, cell);
    sets.push_back({fmt::format("view {} {} {}", azimuth, elevation, cell), grid->size(),
                    [grid](std::uint64_t i) { return grid->ray(i); }});
  }
  return sets;
}

std::string file_name(std::string_view text) {
  std::string safe;
  for (const char c : text)
    safe += std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.' ? c : '_';
  return safe;
}

std::string places(const std::vector<std::uint32_t>& triangles) {
  constexpr std::size_t most = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, triangles.size()); ++i) text += fmt::format(" {}", triangles[i]);
  if (triangles.size() > most) text += fmt::format(" and {} more", triangles.size() - most);
  return text;
}

// `told` is what a store is told of it, if it is reproduced.
Case case_of(const ScanFinding& f, const std::optional<FoundFinding>& told, const Options& options) {
  Case found = f.what;
  found.id = to_word(f.signature);
  found.provenance = {
      f.signature == death_signature ? fmt::format("{} dies of this ray", f.tracer->info().name)
                                     : fmt::format("{} of {}: severity {:.6g} ulps of the largest coordinate",
                                                   name(f.signature.verdict), f.tracer->info().name, f.judgement.ulps),
      fmt::format("found by scan: {}, seed {}, {}, ray {}", options.mesh, options.seed, f.set->name, f.index),
      "triangles of the mesh:" + places(f.triangles)};
  if (told)
    set_known(found, f.tracer->info().name, told->kind);
  else
    found.provenance.push_back(
        "these triangles alone are answered rightly, or wrong in another way: it takes more of the mesh");
  return found;
}

// What was kept of a finding, in this run or in one before.
struct Kept {
  const Tracer* tracer = nullptr;
  Case found;  ///< with its provenance
  double ulps = 0;
  bool reproduced = false;  ///< by the triangles of `found` alone
  std::optional<ShrunkBag> shrunk;
};

double written_severity(const Case& found) {
  for (const std::string& line : found.provenance)
    if (const auto at = line.find("severity "); at != line.npos) return std::strtod(line.c_str() + at + 9, nullptr);
  return 0;
}

class Run {
 public:
  explicit Run(const Options& options) : options_(options), mesh_(read_mesh(options.mesh)) {
    plan_.mesh = &mesh_;
    plan_.sets = sets_of(options, mesh_);
    plan_.tracers = find_tracers(options.tracers, options.foreign);
    plan_.jobs = options.jobs;
    plan_.on_finding = [this](const ScanFinding& f) { take(f); };
    folder_.emplace(options.folder, plan_, options.seed);
    if (!options.store.empty()) store_.emplace((FindingStore(options.store, Open::create), options.store), "scan");
  }

  void run() {
    const ScanState begin = folder_->begin(plan_);
    if (begin.blocks > 0) recall();
    const std::string about_mesh = to_text(report(mesh_)) + "\n";
    Output output;
    output.write(about_mesh);
    output.flush();
    folder_->keep(begin);  // or it's told here that it can't be written
    interruption_.emplace();
    const ScanResult result = scan(plan_, begin, interruption_->came(), [this](const ScanProgress& p) { show(p); });
    folder_->keep(result.state);
    if (result.complete && result.rays == 0)
      fmt::print(stderr, "{}: this scan is complete; nothing is traced again\n", options_.folder);
    const bool plain = !result.complete || !options_.shrink || shrink_findings();
    interruption_.reset();
    if (terminal_) fmt::print(stderr, "\r\x1b[K");
    const std::string table = to_terminal(plan_, result) + findings_table();
    if (result.complete) {
      folder_->write("scan.txt", about_mesh + table);
      folder_->write("scan.csv", to_csv(plan_, result.state));
    }
    output.write(table);
    output.finish();
    if (store_) {
      for (const Tracer* tracer : plan_.tracers) store_->count(tracer->info().name, result.rays);
      store_->finish();
    }
    for (std::size_t t = 0; t < plan_.tracers.size(); ++t)
      fmt::print(stderr, "{}", complaints(plan_.tracers[t]->info().name, result.conduct[t]));
    if (!plain)
      throw std::runtime_error("interrupted while findings were made plain: some are left as they were found");
    if (!result.complete)
      throw std::runtime_error(
          options_.folder.empty() ? "interrupted: this is of the rays done only; with -o DIR it can be taken up"
                                  : fmt::format("interrupted: this is of the rays done only; the same command takes it "
                                                "up in {}",
                                                options_.folder));
  }

 private:
  using Key = std::pair<std::string, std::string>;  // tracer, word of the signature

  void take(const ScanFinding& f) {
    const Key key = {f.tracer->info().name, to_word(f.signature)};
    // What can't be seen again with a few triangles is no case for a store.
    const auto told =
        f.reproduced ? std::optional(for_store(f.tracer->info(), f.signature, f.judgement, f.what)) : std::nullopt;
    const Case found = case_of(f, told, options_);
    folder_->write(path_of(key, ".case"), to_text(found));
    kept_.insert_or_assign(key, Kept{f.tracer, found, f.judgement.ulps, f.reproduced, {}});
    if (store_ && told) store_->add(*told);
  }

  // What a run before this one found.
  void recall() {
    for (const Tracer* tracer : plan_.tracers) {
      for (const std::string& word : folder_->words(file_name(tracer->info().name))) {
        const Key key = {tracer->info().name, word};
        const Case found =
            read_cases((std::filesystem::path(options_.folder) / path_of(key, ".case")).string()).front();
        const BagExamination e = examine_bag(*tracer, found);
        const auto again = signature(e);
        // Of what it takes more of the mesh to see, what was written of it has to do.
        Kept kept{tracer, found, written_severity(found), again && to_word(*again) == word, {}};
        if (kept.reproduced) kept.ulps = e.judgement.ulps;
        plan_.told.emplace(key, kept.ulps);
        kept_.emplace(key, std::move(kept));
      }
    }
  }

  static std::filesystem::path path_of(const Key& key, const char* end) {
    return std::filesystem::path("findings") / file_name(key.first) / (key.second + end);
  }

  FoundFinding for_store(const TracerInfo& tracer, const BagSignature& signature, const BagJudgement& judgement,
                         const Case& what) const {
    return found_bag_finding(tracer, signature, judgement, what, "scan of " + options_.mesh);
  }

  // False where it is interrupted.
  bool shrink_findings() {
    std::size_t at = 0;
    for (auto& [key, kept] : kept_) {
      if (interruption_->came()) return false;
      if (terminal_) fmt::print(stderr, "\r\x1b[Kmaking findings plain: {} of {}", ++at, kept_.size());
      if (!kept.reproduced) continue;
      kept.shrunk = shrink_bag(kept.found, *kept.tracer);
      if (!kept.shrunk) continue;
      const auto& [what, before, after, bits_before, bits_after, tries] = *kept.shrunk;
      const FoundFinding plainer = for_store(kept.tracer->info(), *signature(after), after.judgement, what);
      if (store_) store_->add_plainer(plainer);
      Case simple = kept.found;
      simple.provenance.push_back(fmt::format("shrunk: {} triangles -> {}, {} -> {} significant bits",
                                              kept.found.bag.triangles.size(), what.bag.triangles.size(), bits_before,
                                              bits_after));
      simple.bag = what.bag;
      simple.ray = what.ray;
      set_known(simple, kept.tracer->info().name, plainer.kind);
      folder_->write(path_of(key, ".min.case"), to_text(simple));
    }
    return true;
  }

  std::string findings_table() const {
    if (kept_.empty()) return "";
    TextTable table{{{"tracer"}, {"finding"}, {"severity (ulps)", true}, {"triangles", true}, {"bits", true}}, {}};
    for (const auto& [key, kept] : kept_) {
      const auto& shrunk = kept.shrunk;
      table.rows.push_back({key.first, key.second,
                            kept.ulps > 0 || kept.reproduced ? fmt::format("{:.4g}", kept.ulps) : "?",
                            shrunk            ? std::to_string(shrunk->what.bag.triangles.size())
                            : kept.reproduced ? "?"
                                              : "many",
                            shrunk ? std::to_string(shrunk->bits_after) : "-"});
    }
    std::string text =
        "\nOf each kind a case, in place of which a worse one comes if it is twice as severe; how few triangles and "
        "bits show it (many: it takes more of the mesh than was kept):\n" +
        to_terminal(table);
    if (!options_.folder.empty()) text += fmt::format("Cases: {}/findings\n", options_.folder);
    return text;
  }

  void show(const ScanProgress& p) {
    const auto now = Clock::now();
    if (now - kept_at_ >= std::chrono::seconds(1)) {
      kept_at_ = now;
      folder_->keep(*p.state);
      if (terminal_) {
        if (!first_) first_ = {now, p.rays};
        const double seconds = std::chrono::duration<double>(now - first_->at).count();
        const auto done = static_cast<double>(p.rays - first_->rays), left = static_cast<double>(p.all - p.rays);
        fmt::print(stderr, "\r\x1b[K{:5.1f} % of {} rays, {} kinds of findings",
                   100.0 * static_cast<double>(p.rays) / static_cast<double>(p.all), p.all, kept_.size());
        if (done > 0) fmt::print(stderr, ", about {:.0f} s left", seconds * left / done);
      }
    }
  }

  struct Mark {
    Clock::time_point at;
    std::uint64_t rays;
  };

  const Options& options_;
  Mesh mesh_;
  ScanPlan plan_;
  std::optional<ScanFolder> folder_;
  std::optional<Collector> store_;
  std::optional<Interruption> interruption_;
  std::map<Key, Kept> kept_;
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  Clock::time_point kept_at_ = Clock::now();
  std::optional<Mark> first_;
};

}  // namespace

void add_scan(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("scan", "Your own mesh: where tracers leak, hit the wrong triangle, or nothing at all");
  auto options = std::make_shared<Options>();
  Options& o = *options;
  verb->add_option("MESH", o.mesh, "A mesh: .obj, .ply or .stl")->required();
  verb->add_option(
          "--tracer", o.tracers,
          "Tracer to put to the test, or 'all'; repeatable (default: textbook kernels, BRL-CAD's rules, Embree, exact)")
      ->type_name("NAME");
  add_tracer_timeout(*verb, o.foreign);
  verb->add_option("--rays", o.rays, "Rays in all, shared out evenly among the aims")
      ->check(whole_number())
      ->type_name("N")
      ->capture_default_str();
  verb->add_option("--seed", o.seed, "The same seed gives the same rays")
      ->check(whole_number())
      ->type_name("N")
      ->capture_default_str();
  verb->add_option("--aim", o.aims, "What rays are aimed at, see below; repeatable (default: all)")
      ->check(CLI::IsMember(std::vector<std::string>(scan_aim_names.begin(), scan_aim_names.end())))
      ->type_name("AIM");
  verb->add_option(
          "--view", o.views,
          "A grid of parallel shotlines: azimuth and elevation in degrees, and the size of a cell; repeatable. Without "
          "--aim, only grids are fired")
      ->type_name("AZ EL CELL");
  verb->add_option("--jobs", o.jobs, "Threads; the counts don't depend on them (default: one per core)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  verb->add_flag("!--no-shrink", o.shrink, "Leave the findings as they were found");
  add_findings_option(*verb, o.store);
  verb->add_option("-o", o.folder,
                   "Keep everything in this folder: the table, the CSV, a .case for each finding; the same "
                   "command takes up a scan that was cut off")
      ->type_name("DIR");
  std::string aims = "Aims:\n";
  for (std::size_t k = 0; k < scan_aim_names.size(); ++k)
    aims += fmt::format("  {:<11} {}\n", scan_aim_names[k], scan_aim_summaries[k]);
  verb->footer(
      aims +
      "\nA tracer with a tree of its own (Embree, ODE, VTK, libraries and programs of yours) gets the whole mesh,\n"
      "built once for each thread. One that looks at each triangle gets it up to 1024 triangles, and beyond that,\n"
      "for each ray, the triangles whose boxes the ray meets.\n"
      "Columns: a leak is a miss where something has to be hit by the tracer's contract: inside of a triangle, on\n"
      "an edge, at a vertex. Through: the nearest is missed, and what lies behind it is hit. Beside: what is hit\n"
      "isn't on the ray at all, mostly a neighbour. Lost by culling: the tracer hits that triangle if it is asked\n"
      "about it alone, so that its boxes or its way through them lost it. False hits: where nothing must be hit.\n"
      "Unspecified: the contract leaves it open. Faults: no answer, beyond the tracer's limits or its death, of\n"
      "which a case is kept. Worst: severity in ulps of the largest coordinate at the tracer's own precision, see\n"
      "docs/scan.md. Times are of tracers that get the whole mesh.\n"
      "'exact takes' is the time of the exact nearest hit over the tracer's, best measured with --jobs 1.\n\n" +
      std::string(foreign_tracers_help) +
      "\nExamples:\n"
      "  plumbline mesh make sphere --triangles 500000 --jitter 0.001 --precision binary32 -o sphere.ply\n"
      "  plumbline scan sphere.ply --tracer embree_default --tracer embree_robust -o sphere\n"
      "  plumbline scan part.stl --view 0 0 0.5 --view 45 30 0.5 --tracer ./libmine.so");
  verb->callback([options] { Run(*options).run(); });
}

}  // namespace plumbline
