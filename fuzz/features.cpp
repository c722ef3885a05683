#include "fuzz/features.h"

#include <algorithm>
#include <cmath>

namespace plumbline {
namespace {

// What a cell is about: its number times cells_each, and the bucket, make a Cell.
enum class About : unsigned {
  false_hit,
  false_miss,
  nominal_false_hit,
  nominal_false_miss,
  displacement,
  nominal_displacement,
  residual,
  nominal_residual,
  parting,  // of wish, truth and answer, over the margin
  displacement_by_condition,
  residual_by_condition,
  false_hit_by_condition,
  false_miss_by_condition,
  worst_nominal,
};
constexpr unsigned cells_each = 1024;
static_assert((static_cast<unsigned>(About::worst_nominal) + 1) * cells_each <= plain_cells &&
              worst_nominal_cell == static_cast<unsigned>(About::worst_nominal) * cells_each);

Cell cell(About about, unsigned bucket) { return static_cast<unsigned>(about) * cells_each + bucket; }

// Eighths of an octave, from 2^-8 to 2^56. x >= 0.
unsigned eighth(double x) {
  if (!(x > 0x1p-8)) return 0;
  int exponent;
  const double fraction = std::frexp(std::min(x, 0x1p55), &exponent);  // in [1/2, 1)
  return static_cast<unsigned>((exponent + 8) * 8) + static_cast<unsigned>((fraction - 0.5) * 16);
}
unsigned octaves(double x, unsigned many) { return eighth(x) / 8 / many; }

// Two octaves of the product of the three condition numbers each.
unsigned condition_bucket(const Margins& m) {
  const double product = m.sine * m.altitude * m.size;
  return product > 0 ? static_cast<unsigned>(std::clamp(-std::ilogb(product) / 2, 0, 31)) : 31;
}

class Collector {
 public:
  explicit Collector(Features& features) : features_(features) {}
  void add(Cell c) { features_.cells[features_.size++] = c; }
  void add(About about, unsigned bucket) { add(cell(about, bucket)); }

 private:
  Features& features_;
};

}  // namespace

Features features(const Examination& e, const std::optional<Signature>& found, Wish wish) {
  Features f;
  Collector collect(f);
  if (found) {
    f.found = finding_ulps(e, *found);
    collect.add(signature_cell | found->key());
  }
  if (!e.margins) return f;
  const Margins& m = *e.margins;
  f.nominal = e.nominal();
  f.severity = e.severity_ulps();
  constexpr double most = 0x1p55;
  const double displacement = std::min(e.displacement, most), residual = std::min(e.residual, most);
  f.error = std::max(4 * f.severity, displacement);
  const unsigned at = condition_bucket(m);
  if (displacement > 0) {
    collect.add(About::displacement, eighth(displacement));
    collect.add(About::displacement_by_condition, octaves(displacement, 2) * 32 + at);
    if (f.nominal) collect.add(About::nominal_displacement, eighth(displacement));
  }
  if (residual > 0) {
    collect.add(About::residual, eighth(residual));
    collect.add(About::residual_by_condition, octaves(residual, 2) * 32 + at);
    if (f.nominal) collect.add(About::nominal_residual, eighth(residual));
  }
  if (f.severity > 0) {
    const bool hit = e.verdict == VerdictKind::false_hit;
    collect.add(hit ? About::false_hit : About::false_miss, eighth(f.severity));
    collect.add(hit ? About::false_hit_by_condition : About::false_miss_by_condition, octaves(f.severity, 2) * 32 + at);
    if (f.nominal) {
      collect.add(hit ? About::nominal_false_hit : About::nominal_false_miss, eighth(f.severity));
      collect.add(About::worst_nominal, 0);
    }
  }
  const unsigned parting = static_cast<unsigned>(wish) * 4 + m.hit * 2u + (e.answer.outcome == Outcome::hit);
  collect.add(About::parting, parting * 32 + octaves(m.severity_ulps, 2));
  return f;
}

}  // namespace plumbline
