// A finding's case looked at once more, by this build: what its tracer says, what is true and by how much, what all
// the other tracers say, and whether the cases beside it are wrong too.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "analysis/ask.h"
#include "analysis/examine.h"
#include "analysis/signature.h"
#include "findings/finding_row.h"
#include "oracle/explain.h"
#include "oracle/judge.h"

namespace plumbline {

/// Of the 30 cases that differ by one ulp in one coordinate.
struct Neighbours {
  unsigned asked = 0, wrong = 0;
};

struct Look {
  Triangle triangle;  ///< at the precision of the tracer
  Ray given;
  Contract contract;
  bool own_query = false;   ///< the tracer was asked something else than the ray given
  Query query;              ///< this, in the range that its contract says is searched
  Certificate certificate;  ///< of the query
  Duty duty = Duty::any;    ///< what the contract asks of the tracer there
  std::optional<Margins> margins;
  double longest_edge_ulps = 0;
  // Where this build has the tracer:
  std::optional<Answer> answer;
  VerdictKind verdict = VerdictKind::correct;
  std::optional<Signature> signature;  ///< none: it is right now
  double ulps = 0;  ///< how badly it is wrong; where the tracer is missing or right, what was found
  std::optional<Neighbours> neighbours;  ///< none: not asked, since the tracer may die of each
};

/// The case has one triangle. `tracer` may be null.
Look look(const FoundCase& found, FindingKind kind, const Tracer* tracer);

/// What one tracer makes of the case, of one triangle or several.
struct OtherOpinion {
  Outcome outcome = Outcome::miss;
  VerdictKind verdict = VerdictKind::correct;
  double ulps = 0;         ///< severity, where it is wrong
  bool rounded = false;    ///< the case had to be rounded to the tracer's precision, and is another one
  bool own_query = false;  ///< the tracer was asked something else than the ray
};
std::vector<OtherOpinion> opinions(const Case& asked, std::span<const Tracer* const> tracers);

}  // namespace plumbline
