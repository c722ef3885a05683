#include "analysis/examine.h"

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <limits>

#include "case/float_bits.h"
#include "oracle/classify.h"
#include "oracle/judge.h"

namespace plumbline {
namespace {

double off(double answered, double exact, double scale) {
  if (!is_finite(answered)) return std::numeric_limits<double>::infinity();
  return std::abs(answered - exact) * scale;
}

// Errors of t grow with t: where a range ends far away, they are no errors of a nominal case.
bool ends_far(const Ray& ray, const Margins& m, Precision precision) {
  const Vec3& d = ray.direction;
  const double step = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  const double largest = m.ulp * (precision == Precision::binary32 ? 0x1p24 : 0x1p53);
  return std::ranges::any_of(std::array{ray.t_min, ray.t_max},
                             [&](double t) { return is_finite(t) && std::abs(t) * step > largest; });
}

}  // namespace

double Examination::severity_ulps() const {
  if (!wrong() || !margins || margins->hit == (answer.outcome == Outcome::hit)) return 0;
  return margins->severity_ulps;
}

Examination examine(const Triangle& triangle, const Ray& ray, const Query& asked, const Answer& answer,
                    const Contract& contract, Measure measure) {
  Examination e;
  e.precision = contract.precision;
  e.triangle = triangle;
  e.answer = answer;
  e.query = searched_ray(asked, contract);
  const auto take_margins = [&] { e.margins = margins(triangle, e.query, contract.precision); };
  if (measure == Measure::all) take_margins();
  e.truth = e.margins ? e.margins->truth : classify(triangle, e.query);
  e.verdict = judge(triangle, asked, e.truth, e.answer, contract);
  if (measure == Measure::wrong_answers && e.wrong()) take_margins();
  // Of the ray as given: where a segment ends that an interface makes of it is the interface's choice.
  if (e.margins) e.far_range = ends_far(searched_ray(ray, contract).ray, *e.margins, contract.precision);
  if (e.margins && e.answer.outcome == Outcome::hit && e.truth.det_sign != 0) {
    const Margins& m = *e.margins;
    if (e.answer.has_t) e.residual = off(e.answer.t, m.t, m.t_scale) / m.ulp;
    if (e.answer.has_uv)
      e.displacement = std::max(off(e.answer.u, m.u, m.u_scale), off(e.answer.v, m.v, m.v_scale)) / m.ulp;
  }
  return e;
}

Examiner::Examiner(const Tracer& tracer, Measure measure, Bag object)
    : tracer_(tracer), measure_(measure), bag_(std::move(object)) {
  bag_.triangles.resize(1);
}

Examination Examiner::examine(const Triangle& triangle, const Ray& ray) {
  bag_.triangles.front() = triangle;
  std::feclearexcept(FE_OVERFLOW | FE_UNDERFLOW);
  const auto bag = tracer_.prepare(bag_);
  Answer answer;
  bag->trace({&ray, 1}, {&answer, 1});
  const bool out_of_range = std::fetestexcept(FE_OVERFLOW | FE_UNDERFLOW) != 0;
  Examination e = plumbline::examine(triangle, ray, bag->asked(ray), answer, tracer_.info().contract, measure_);
  e.out_of_range = out_of_range;
  if (e.verdict == VerdictKind::false_miss) e.rejection = bag->rejection(ray);
  e.died = !bag->conduct().deaths.empty();
  conduct_ += bag->conduct();
  return e;
}

}  // namespace plumbline
