// What a repro has to tell: a case of one triangle, whom it is told of, what is true, what was said. Private to
// repros/.
#pragma once
#include <optional>
#include <string>

#include "analysis/signature.h"
#include "case/answer.h"
#include "case/case.h"
#include "case/contract.h"
#include "case/query.h"
#include "oracle/judge.h"
#include "oracle/measure.h"
#include "oracle/severity.h"
#include "oracle/truth.h"

namespace plumbline {

struct Evidence {
  Case what;           ///< one triangle, valid, of the contract's precision
  std::string tracer;  ///< empty: told of nobody
  std::string call;    ///< what is under test: function or paper, package and version; empty: not known here
  Contract contract;
  Query query;            ///< what it is really asked, in the range that it searches
  Truth truth;            ///< of that
  Duty duty = Duty::any;  ///< of the contract, with its slack
  /// Where the line crosses the plane: t, u, v rounded, and how far off those of a hit may be (signature.h:
  /// displaced).
  std::optional<Coordinates<double>> exact, leeway;
  std::optional<Answer> answer;  ///< no value: this build hasn't that tracer
  std::optional<FindingKind> wrong;
  double ulps = 0;  ///< how badly (finding_ulps)

  const Triangle& triangle() const { return what.bag.triangles.front(); }
  const Ray& ray() const { return what.ray; }
  /// Whether t, u and v of a hit have to be the exact ones.
  bool has_numbers() const { return exact && duty == Duty::hit; }
};

/// Asks the tracer, if this build has it; `otherwise` is the contract of one that it hasn't, without which there has
/// to be one. Throws InputError where the case isn't one valid triangle in numbers of the contract's precision.
Evidence gather(const Case& what, std::string_view tracer, const std::optional<Contract>& otherwise = std::nullopt);

/// Throws InputError where a number isn't of the precision that `tracer`, words of a message, reads.
void require_precision(const Case& what, Precision precision, std::string_view tracer);

/// For programs, which ask again: throws InputError as well where the case is beyond what the tracer takes.
Evidence gather_to_ask(const Case& what, std::string_view tracer,
                       const std::optional<Contract>& otherwise = std::nullopt);

/// One sentence: who is wrong, and how.
std::string headline(const Evidence& evidence);

/// Headline, build or run command, id and provenance, and the exact reasons, as lines; what is foreign in it is
/// harmless.
std::string story(const Evidence& evidence, std::string_view command);

/// "a hit with t = 0x1p+0 (1)", "a miss"
std::string said(const Answer& answer);

}  // namespace plumbline
