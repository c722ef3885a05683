// A store of findings: a row for each signature of each tracer, over any number of searches.
//
// Two files. DB.ndjson is the journal (journal.h), and the truth. DB is an SQLite database, a cache: the fold of the
// journal's lines up to a place that it holds itself, so that wherever a process is killed, or the disk is full, the
// next one goes on from there, and the rows are the same when the database is deleted and made anew. Whoever only
// tells events needs a Journal alone.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/case_lines.h"
#include "findings/database.h"
#include "findings/finding_row.h"
#include "findings/journal.h"

namespace plumbline {

struct RowFilter {
  bool only_open = false, only_new = false;
  std::string tracer = {};  ///< empty: any
  bool details = true;      ///< the cases (else without `what`) and the builds
};

class FindingStore {
 public:
  /// Takes in what the journal has. Throws InputError as Journal does; where the database is damaged, of something
  /// else or of a newer Plumbline; where a line of the journal is damaged: each names the fix.
  explicit FindingStore(const std::string& path, Open how = Open::existing);

  /// Those that are nominal first, the worst first.
  std::vector<FindingRow> rows(const RowFilter& filter = {});
  std::optional<FindingRow> row(std::int64_t id);
  /// In the order in which they ended.
  std::vector<SearchRow> searches();

  void tell(const Event& event);
  /// `by` is "person" or "retest". Throws InputError for an id that isn't there; where a finding would be a duplicate
  /// of itself.
  void set_status(std::int64_t id, FindingStatus status, std::int64_t duplicate_of, const std::string& by);

 private:
  friend std::vector<std::string> rebuild(const std::string& path);
  enum class Damaged : unsigned char { refused, skipped };
  FindingStore(const std::string& path, const std::string& file, Open how);

  void prepare_schema();
  JournalPlace folded();
  std::vector<std::string> catch_up(Damaged lines = Damaged::refused);
  std::vector<FindingRow> select(const std::string& where, const RowFilter& filter);
  Case example(const FindingRow& row, std::string_view which, double ulps);
  FindingName name_of(std::int64_t id);

  std::string path_;
  Journal journal_;
  Database database_;
  CaseObjects cases_;
};

/// Makes the database anew from the journal, without the lines that are damaged: a warning for each. What was there
/// stays as PATH.old.
std::vector<std::string> rebuild(const std::string& path);

}  // namespace plumbline
