#include "analysis/tracers.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "case/finite.h"
#include "case/input_error.h"
#include "case/nearest_name.h"
#include "float_tracer/adapters/adapter_list.h"
#include "float_tracer/kernel_list.h"
#include "float_tracer/kernel_tracer.h"
#include "float_tracer/pipe_tracer.h"
#include "float_tracer/plugin.h"
#include "float_tracer/tracer_list.h"
#include "float_tracer/variants/variants.h"
#include "oracle/bag/scene.h"
#include "oracle/classify.h"
#include "oracle/measure.h"

namespace plumbline {
namespace {

class PreparedExact final : public PreparedBag {
 public:
  explicit PreparedExact(const Bag& bag) : triangles_(bag.triangles) {
    const auto finite = [](const Triangle& t) { return is_finite(t); };
    if (triangles_.size() > 1 && std::ranges::all_of(triangles_, finite)) scene_.emplace(triangles_);
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = nearest(rays[i]);
  }

  // Of two hits at exactly the same t, the first triangle's. There is no answer to an invalid question.
  Answer nearest(const Ray& ray) const {
    if (triangles_.empty()) return {};
    const Truth truth = classify(triangles_.front(), ray);
    if (truth.invalid != Invalid::none || (triangles_.size() > 1 && !scene_)) return {.outcome = Outcome::fault};
    if (!scene_) return crosses(truth) ? hit_of(0, ray) : Answer{};
    const Query query = ray;
    NearestHits hits;
    scene_->nearest({&query, 1}, hits);
    return hits.of(0).empty() ? Answer{} : hit_of(hits.of(0).front().triangle, ray);
  }

  Answer hit_of(std::uint32_t triangle, const Ray& ray) const {
    const auto [t, u, v] = *measure<double>(triangles_[triangle], ray);
    return {.outcome = Outcome::hit, .has_t = true, .has_uv = true, .triangle = triangle, .t = t, .u = u, .v = v};
  }

  std::vector<Triangle> triangles_;
  std::optional<Scene> scene_;  // of several triangles; none, if one of them isn't finite
};

class ExactTracer final : public Tracer {
 public:
  ExactTracer()
      : Tracer({.name = "exact",
                .summary = "the oracle as a tracer: the control that is wrong nowhere",
                .source = "oracle/README.md",
                .contract = {}}) {}
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override { return std::make_unique<PreparedExact>(bag); }
};

// By what they were asked for.
std::map<std::string, std::unique_ptr<Tracer>, std::less<>>& foreign_tracers() {
  static std::map<std::string, std::unique_ptr<Tracer>, std::less<>> tracers;
  return tracers;
}

// The one place where foreign tracers are made. Either kind runs in processes of its own.
std::unique_ptr<Tracer> make_foreign(const std::string& name, const ForeignOptions& options) {
  if (names_pipe(name)) return pipe_tracer(name, options.timeout);
  return load_plugin(name, options.timeout);
}

const Tracer& find_foreign(std::string_view name, const ForeignOptions& options) {
  auto& known = foreign_tracers();
  if (const auto it = known.find(name); it != known.end()) return *it->second;
  const std::string asked(name);
  auto made = make_foreign(asked, options);
  const std::string& own_name = made->info().name;
  if (tracer_named(own_name))
    throw InputError(
        fmt::format("{}: calls itself '{}', as another tracer here does; give it a name of its own", name, own_name));
  return *known.emplace(asked, std::move(made)).first->second;
}

}  // namespace

const std::vector<std::unique_ptr<Tracer>>& all_tracers() {
  static const auto tracers = [] {
    auto list = float_tracers();
    list.push_back(std::make_unique<ExactTracer>());
    return list;
  }();
  return tracers;
}

std::vector<const Tracer*> standard_tracers() {
  constexpr std::string_view names[] = {
      "moller_trumbore_f32", "moller_trumbore_f64", "woop_watertight_f32", "woop_watertight_f64",
      "plucker_f32",         "plucker_f64",         "baldwin_weber_f32",   "baldwin_weber_f64",
      "brlcad_bot_classic",  "brlcad_bot_hlbvh",    "brlcad_bot_classic_kernel",
      "embree_default",      "embree_robust",       "exact"};
  std::vector<const Tracer*> list;
  for (const auto& tracer : all_tracers())
    if (std::ranges::find(names, tracer->info().name) != std::end(names)) list.push_back(tracer.get());
  return list;
}

const Tracer* tracer_named(std::string_view name) {
  for (const auto& tracer : all_tracers())
    if (tracer->info().name == name) return tracer.get();
  for (const auto& [asked_for, tracer] : foreign_tracers())
    if (tracer->info().name == name) return tracer.get();
  return nullptr;
}

const std::vector<AbsentTracer>& absent_tracers() {
  static const auto absent = [] {
    const std::string other_processor = "a processor with its instructions";
    std::vector<AbsentTracer> list;
    const auto add = [&list](std::string name, std::string_view package, const std::string& needs) {
      if (std::ranges::none_of(all_tracers(), [&](const auto& tracer) { return tracer->info().name == name; }))
        list.push_back({std::move(name), std::string(package), needs});
    };
    for (const char* suffix : {fma_suffix, fast_math_suffix, ftz_daz_suffix})
      for_each_kernel(
          [&]<class Kernel>() { add(KernelTracer<Kernel>().info().name + suffix, "", other_processor); });
    for (const Adapter& adapter : adapters())
      for (const std::string_view name : adapter.tracers)
        add(std::string(name), adapter.package,
            adapter.make ? other_processor : fmt::format("{}, and a new build", adapter.needs));
    return list;
  }();
  return absent;
}

const AbsentTracer* absent_tracer_named(std::string_view name) {
  const auto it = std::ranges::find(absent_tracers(), name, &AbsentTracer::name);
  return it == absent_tracers().end() ? nullptr : &*it;
}

std::string asked_for(const Tracer& tracer) {
  for (const auto& [name, foreign] : foreign_tracers())
    if (foreign.get() == &tracer) return name;
  return tracer.info().name;
}

std::string suggest_tracer(std::string_view name) {
  if (const AbsentTracer* absent = absent_tracer_named(name)) return fmt::format("it needs {}", absent->needs);
  std::vector<std::string_view> names;
  for (const auto& tracer : all_tracers()) names.push_back(tracer->info().name);
  return suggest(name, names);
}

const Tracer& find_tracer(std::string_view name, const ForeignOptions& options) {
  if (names_pipe(name) || names_plugin(name)) return find_foreign(name, options);
  if (const Tracer* tracer = tracer_named(name)) return *tracer;
  throw InputError(fmt::format("unknown tracer '{}'; {}", name, suggest_tracer(name)));
}

std::vector<const Tracer*> find_tracers(const std::vector<std::string>& names, const ForeignOptions& options) {
  if (names.empty()) return standard_tracers();
  std::vector<const Tracer*> list;
  for (const std::string& name : names) {
    if (name != "all") {
      list.push_back(&find_tracer(name, options));
      continue;
    }
    for (const auto& tracer : all_tracers()) list.push_back(tracer.get());
  }
  return list;
}

}  // namespace plumbline
