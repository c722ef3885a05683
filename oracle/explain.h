// Why: the exact numbers behind a class and a verdict, for people: as values with their meaning, and as text.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "case/answer.h"
#include "case/contract.h"
#include "case/query.h"
#include "oracle/truth.h"

namespace plumbline {

/// A number whose sign decides.
struct ExactNumber {
  std::string exact;  ///< in lowest form, an integer times a power of two: "-3 * 2^-2"
  int sign = 0;
};

/// A fraction in lowest terms, "1/3", and the numbers nearest to it.
struct ExactRatio {
  std::string exact;
  double binary64 = 0;
  float binary32 = 0;
};

/// The numbers that prove a class. Of an invalid case there are none.
struct Certificate {
  Truth truth;
  std::optional<bool> hit;  ///< as contact.h says; none: open, contact without a crossing
  std::string where;        ///< what the signs come to, or why the case is invalid
  ExactNumber det, T, w_ab, w_bc, w_ca;
  std::optional<ExactRatio> t, u, v;  ///< where det != 0
  std::string range;                  ///< how t lies in the ray's range, where det != 0
};
Certificate certificate(const Triangle& triangle, const Query& query);

/// What the sign of a w means beside that of det, which is not 0: "the sign of det: inner side".
std::string_view side(int w_sign, int det_sign);

/// Several lines: the inputs in hexfloat and decimal, det, T and the w as integers times a power of two, what their
/// signs mean, t, u, v exact and rounded.
std::string explain(const Triangle& triangle, const Query& query);

/// The same without the lines of the query, for one of several triangles.
std::string explain_triangle(const Triangle& triangle, const Query& query);

/// The reason for the verdict on an answer: what the contract asks, what was said, the severity.
std::string explain_verdict(const Triangle& triangle, const Query& query, const Answer& answer, const Contract& contract);

}  // namespace plumbline
