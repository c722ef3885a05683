// Reads cases and answers from NDJSON: one JSON object a line, for pipes. The keys: `plumbline classify --help`.
//
// A number is a JSON number, or a string with a hexfloat, "inf", "-inf" or "nan". A coordinate or bound that
// is not finite (1e999 is infinite) is data: the oracle calls such a case invalid. All else that is wrong throws
// InputError "file:line:column: what; the fix": malformed JSON, unknown or repeated keys, wrong types, a missing key,
// a plate without thickness, a thickness without plate. A line at a time: memory is bounded by the longest line. Blank
// lines are skipped, and a byte order mark.
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "case/answer.h"
#include "case/case.h"

namespace plumbline {

/// What a line says.
struct CaseLine {
  std::string id = "null";       ///< JSON text of the scalar, as it was
  Case asked;                    ///< its id: the same as plain text
  std::optional<Answer> answer;  ///< where the line has a key `hit`; hit null, or fault true: a fault
  std::string tracer;            ///< who answered, if the line says
};

class CaseLines {
 public:
  /// "-" is standard input.
  explicit CaseLines(const std::string& path);
  ~CaseLines();

  /// Reads the next line into `line`, whose memory is used again; false at the end.
  bool next(CaseLine& line);
  /// Whether next() would answer without waiting for more input: if not, it's time to flush what was answered.
  bool ready();
  /// Throws InputError about the line read last.
  [[noreturn]] void fail(std::string_view message) const;

 private:
  class Impl;  // keeps simdjson's header out of ours
  std::unique_ptr<Impl> impl_;
};

/// Reads cases that are objects within other JSON, one after another. `id` may be missing.
class CaseObjects {
 public:
  /// `name` stands for the file in messages.
  explicit CaseObjects(std::string name);
  ~CaseObjects();

  /// Throws InputError as CaseLines::next does. The objects are counted from 1.
  Case read(std::string_view object);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// What a line says that is an answer alone.
struct AnswerLine {
  std::string id;  ///< JSON text of the scalar
  Answer answer;
};

/// Reads the answers of a program, line by line. What the lines repeat of the case may be there and isn't looked at.
class AnswerReader {
 public:
  /// `name` stands for the file in messages.
  explicit AnswerReader(std::string name);
  ~AnswerReader();

  /// Throws InputError as CaseLines::next does; also for a line without `hit`. The lines are counted from 1.
  AnswerLine read(std::string_view line);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumbline
