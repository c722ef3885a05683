#include "analysis/case_sources.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>

#include "analysis/ask.h"
#include "case/case_files.h"
#include "case/case_text.h"
#include "case/enum_names.h"
#include "case/hard_families.h"
#include "case/input_error.h"
#include "case/lattice.h"
#include "case/nearest_name.h"
#include "case/targets.h"

namespace plumbline {
namespace {

constexpr std::uint64_t count_of_family = 1000;

// Hands out as many as are asked for.
class Counter {
 public:
  Counter(const SourceOptions& options, const std::function<void(const Case&)>& take)
      : precision_(options.precision),
        take_(take),
        left_(options.count.value_or(std::numeric_limits<std::uint64_t>::max())) {}

  bool enough() const { return left_ == 0; }

  void take(Case made) {
    if (enough()) return;
    --left_;
    if (precision_) {
      made = put_at(std::move(made), *precision_);
      made.precision = *precision_;
    }
    take_(made);
  }

 private:
  std::optional<Precision> precision_;
  const std::function<void(const Case&)>& take_;
  std::uint64_t left_;
};

void generate_family(Family family, const SourceOptions& options, Counter& counter) {
  const std::uint64_t count = options.count.value_or(count_of_family);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Shot shot = draw(family, options.seed, i);
    Case made;
    made.id = fmt::format("{}-{}-{}", name(family), options.seed, i);
    made.bag.triangles = {shot.triangle};
    made.ray = shot.ray;
    counter.take(std::move(made));
  }
}

void generate_report(Counter& counter) {
  const LatticeAxis axis = {parse_decimal("2", "box"), parse_decimal("1.5", "step"), parse_decimal("0", "offset")};
  const Lattice lattice = make_lattice({axis, axis, axis});
  const Aiming aiming;
  const std::vector<Aim> aimed = aims(aiming);
  std::vector<Ray> rays(aimed.size());
  for (std::uint64_t index = 0; index < triple_count(lattice) && !counter.enough(); ++index) {
    const LatticeTriple triple = triple_at(lattice, index);
    if (collinear(triple)) continue;
    Case made;
    made.bag.triangles = {triangle_of(lattice, triple)};
    aim_rays(made.bag.triangles.front(), aiming, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      made.id = fmt::format("{}-{}-{}", report_source, index, i);
      made.ray = rays[i];
      made.aim = aimed[i];
      counter.take(made);
    }
  }
}

}  // namespace

std::vector<std::string_view> source_names() {
  std::vector<std::string_view> names = {report_source};
  names.insert(names.end(), family_names.begin(), family_names.end());
  return names;
}

void generate(const std::string& source, const SourceOptions& options, const std::function<void(const Case&)>& take) {
  Counter counter(options, take);
  if (source == report_source) return generate_report(counter);
  if (const auto family = from_name<Family>(family_names, source)) return generate_family(*family, options, counter);
  const bool path = source.find_first_of("/.") != source.npos;
  if (!path && !std::filesystem::exists(source))
    throw InputError(
        fmt::format("unknown source '{}', and no such file or folder; {}", source, suggest(source, source_names())));
  for (const std::string& file : case_files(source))
    for (Case& found : read_cases(file)) counter.take(std::move(found));
}

}  // namespace plumbline
