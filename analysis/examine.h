// One tracer asked and judged case by case, as a search does it: a triangle and a ray at a time, with how near the case
// is to another answer. What a report says of a finding is measured exactly, by oracle/severity.h; this is what a search
// climbs on.
#pragma once
#include <memory>

#include "analysis/ask.h"
#include "case/query.h"
#include "float_tracer/rejection.h"
#include "oracle/margins.h"

namespace plumbline {

struct Examination {
  Precision precision = Precision::binary64;
  Triangle triangle;
  Query query;  ///< what the tracer was really asked, in the range that its contract says is searched
  Answer answer;
  Truth truth;
  VerdictKind verdict = VerdictKind::correct;
  std::optional<Margins> margins;  ///< of triangle and query, where wanted
  /// By how much a hit is displaced in the triangle by its u and v, and off its plane by its t: lengths in ulps of the
  /// largest coordinate. 0 where the answer or the truth has no such number; infinite where the answer's is not finite.
  double displacement = 0, residual = 0;
  Rejection rejection = Rejection::none;  ///< of a false miss, where the tracer tells
  bool far_range = false;  ///< an end of the ray's range is farther from the origin than the largest coordinate is from 0
  bool out_of_range = false;  ///< a number of the tracer's, in this process, over- or underflowed
  bool died = false;                      ///< the tracer, of this case

  /// Whether the contract is broken. Where the truth is the opposite too, severity_ulps() tells by how much.
  bool wrong() const { return plumbline::wrong(verdict); }
  /// How wrong a wrong answer is, in ulps of the largest coordinate at the tracer's precision; 0 where the answer is right,
  /// or wrong by convention alone (an edge, an end of the range, a culled side).
  double severity_ulps() const;
  bool nominal() const { return margins && margins->condition().nominal() && !far_range && !out_of_range; }
};

/// Whose margins are wanted.
enum class Measure : unsigned char { all, wrong_answers };

/// An answer that was given, `asked` being what the tracer was really asked of `ray`. What only the tracer itself can
/// tell stays unknown: by which of its tests it missed, over- and underflow, death.
Examination examine(const Triangle& triangle, const Ray& ray, const Query& asked, const Answer& answer,
                    const Contract& contract, Measure measure = Measure::all);

class Examiner {
 public:
  /// `object` is what the triangle is: a surface, a plate and so on; its triangles aren't looked at.
  explicit Examiner(const Tracer& tracer, Measure measure = Measure::all, Bag object = {});

  /// The numbers are of the tracer's precision. The tracer is asked with a bag of its own.
  Examination examine(const Triangle& triangle, const Ray& ray);

  const Tracer& tracer() const { return tracer_; }
  /// What the tracer did up to now.
  const Conduct& conduct() const { return conduct_; }

 private:
  const Tracer& tracer_;
  Measure measure_;
  Bag bag_;
  Conduct conduct_;
};

}  // namespace plumbline
