#include "findings/store.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "analysis/found_case.h"
#include "case/case_json.h"
#include "case/enum_names.h"
#include "case/input_error.h"
#include "case/printable.h"
#include "findings/event_reader.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t application_id = 0x506c6266;  // "Plbf"
// Of the schema. An older database is made anew from its journal: there is nothing to migrate in a cache.
constexpr std::int64_t version = 1;

constexpr const char* schema = R"(
  CREATE TABLE journal (identity TEXT NOT NULL, bytes INTEGER NOT NULL, lines INTEGER NOT NULL) STRICT;
  CREATE TABLE finding (
    id INTEGER PRIMARY KEY,
    tracer TEXT NOT NULL, signature TEXT NOT NULL, kind TEXT NOT NULL, element TEXT NOT NULL, conditioning TEXT NOT NULL,
    count INTEGER NOT NULL,
    first_line INTEGER NOT NULL, first_seen TEXT NOT NULL, last_seen TEXT NOT NULL,
    status TEXT NOT NULL, duplicate_of INTEGER REFERENCES finding (id),
    worst_ulps REAL NOT NULL, worst_bits INTEGER NOT NULL, worst_line INTEGER NOT NULL,
    simplest_ulps REAL NOT NULL, simplest_bits INTEGER NOT NULL, simplest_line INTEGER NOT NULL,
    UNIQUE (tracer, signature)) STRICT;
  -- The cases, apart: so that a list of findings needn't read them.
  CREATE TABLE example (
    finding INTEGER NOT NULL REFERENCES finding (id), which TEXT NOT NULL, found TEXT NOT NULL, text TEXT NOT NULL,
    PRIMARY KEY (finding, which)) STRICT, WITHOUT ROWID;
  CREATE TABLE build (
    finding INTEGER NOT NULL REFERENCES finding (id), build TEXT NOT NULL,
    PRIMARY KEY (finding, build)) STRICT, WITHOUT ROWID;
  CREATE TABLE search (
    line INTEGER PRIMARY KEY,
    tracer TEXT NOT NULL, source TEXT NOT NULL, ended TEXT NOT NULL, executions INTEGER NOT NULL,
    worst_nominal_ulps REAL NOT NULL, least_margin_ulps REAL NOT NULL, signatures INTEGER NOT NULL) STRICT;
  CREATE INDEX search_by_tracer ON search (tracer, line);)";

constexpr std::string_view add_finding = R"(
  INSERT INTO finding (tracer, signature, kind, element, conditioning, count, first_line, first_seen, last_seen, status,
                       worst_ulps, worst_bits, worst_line, simplest_ulps, simplest_bits, simplest_line)
  VALUES (?1, ?2, ?3, ?4, ?5, 1, ?6, ?7, ?7, 'open', ?8, ?9, ?6, ?8, ?9, ?6)
  ON CONFLICT (tracer, signature) DO UPDATE SET
    count = count + 1, last_seen = excluded.last_seen, status = iif(status = 'fixed', 'open', status),
    worst_ulps = iif(excluded.worst_ulps > worst_ulps, excluded.worst_ulps, worst_ulps),
    worst_bits = iif(excluded.worst_ulps > worst_ulps, excluded.worst_bits, worst_bits),
    worst_line = iif(excluded.worst_ulps > worst_ulps, excluded.worst_line, worst_line),
    simplest_ulps = iif(excluded.simplest_bits < simplest_bits, excluded.simplest_ulps, simplest_ulps),
    simplest_bits = iif(excluded.simplest_bits < simplest_bits, excluded.simplest_bits, simplest_bits),
    simplest_line = iif(excluded.simplest_bits < simplest_bits, excluded.simplest_line, simplest_line))";

// If it is the worst or the simplest now.
constexpr std::string_view add_examples = R"(
  INSERT OR REPLACE INTO example
  SELECT id, 'worst', ?4, ?5 FROM finding WHERE tracer = ?1 AND signature = ?2 AND worst_line = ?3 UNION ALL
  SELECT id, 'simplest', ?4, ?5 FROM finding WHERE tracer = ?1 AND signature = ?2 AND simplest_line = ?3)";

constexpr std::string_view add_build =
    "INSERT OR IGNORE INTO build SELECT id, ?3 FROM finding WHERE tracer = ?1 AND signature = ?2";
constexpr std::string_view add_search = "INSERT INTO search VALUES (?, ?, ?, ?, ?, ?, ?, ?)";
constexpr std::string_view set_status_of = R"(
  UPDATE finding SET status = ?3, duplicate_of = (SELECT id FROM finding WHERE tracer = ?4 AND signature = ?5)
  WHERE tracer = ?1 AND signature = ?2)";

// New: since the last search of this tracer but one ended.
constexpr std::string_view select_findings = R"(
  SELECT id, tracer, signature, kind, element, conditioning, count, first_seen, last_seen, status, duplicate_of,
         first_line > coalesce((SELECT line FROM search WHERE search.tracer = finding.tracer
                                ORDER BY line DESC LIMIT 1 OFFSET 1), 0) AS is_new,
         worst_ulps, worst_bits, simplest_ulps, simplest_bits
  FROM finding WHERE )";
constexpr std::string_view worst_first =
    " ORDER BY conditioning = 'nominal' DESC, worst_ulps DESC, tracer, signature";

std::string case_text(const Case& what) {
  std::string text;
  JsonObject json(text);
  add_members(json, what);
  json.end_line();
  return text;
}

std::int64_t whole(std::uint64_t count) { return static_cast<std::int64_t>(count); }

// Applies events to the database, in their order.
class Fold {
 public:
  explicit Fold(Database& database)
      : database_(database),
        finding_(database.prepare(add_finding)),
        examples_(database.prepare(add_examples)),
        build_(database.prepare(add_build)),
        search_(database.prepare(add_search)),
        status_(database.prepare(set_status_of)) {}

  void apply(const FoundFinding& f, std::int64_t line) {
    const std::string found = printable(fmt::format("found {} by {}, with {}", f.seen, f.source, f.build));
    finding_
        .with(f.tracer, f.signature, name(f.kind), name(f.element), name(f.conditioning), line, f.seen, f.found.ulps,
              std::int64_t{f.found.bits})
        .run();
    examples_.with(f.tracer, f.signature, line, found, case_text(f.found.what)).run();
    build_.with(f.tracer, f.signature, f.build).run();
  }

  void apply(const SearchRow& s, std::int64_t line) {
    search_
        .with(line, s.tracer, s.source, s.ended, whole(s.executions), s.worst_nominal_ulps, s.least_margin_ulps,
              whole(s.signatures))
        .run();
  }

  void apply(const StatusSet& s, std::int64_t) {
    status_
        .with(s.finding.tracer, s.finding.signature, name(s.status), s.duplicate_of.tracer, s.duplicate_of.signature)
        .run();
    if (database_.changes() == 0) throw InputError("a status of what is not among the findings before it");
  }

 private:
  Database& database_;
  Statement finding_, examples_, build_, search_, status_;
};

std::string rebuild_command(const std::string& path) { return fmt::format("'plumbline triage rebuild {}'", path); }

}  // namespace

FindingStore::FindingStore(const std::string& path, Open how) : FindingStore(path, path, how) {
  prepare_schema();
  catch_up();
}

// The database in a file of another name than the store's, as it is.
FindingStore::FindingStore(const std::string& path, const std::string& file, Open how)
    : path_(path),
      journal_(path, how),
      database_(file, fmt::format("{} makes it anew from {}", rebuild_command(path), journal_.path()),
                fmt::format("make room: nothing is lost, {} holds it all", journal_.path())),
      cases_(path) {}

void FindingStore::prepare_schema() {
  const std::int64_t application = database_.integer("PRAGMA application_id"),
                     found = database_.integer("PRAGMA user_version");
  const bool empty = application == 0 && found == 0 && database_.integer("SELECT count(*) FROM sqlite_schema") == 0;
  if (!empty && application != application_id)
    database_.fail_as_damaged("a database of something else than Plumbline's findings");
  if (found > version)
    database_.fail_as_damaged(fmt::format("of a newer Plumbline (schema {}, this one has {})", found, version));
  database_.run("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA foreign_keys = ON");
  if (found < version) {
    Transaction transaction(database_);
    if (database_.integer("PRAGMA user_version") < version) {  // else another process was first
      database_.run(
          "DROP TABLE IF EXISTS build; DROP TABLE IF EXISTS example; DROP TABLE IF EXISTS finding; DROP TABLE IF "
          "EXISTS search; "
          "DROP TABLE IF EXISTS journal");
      database_.run(schema);
      database_.prepare("INSERT INTO journal VALUES (?, 0, 0)").with(journal_.identity()).run();
      database_.run(
          fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", application_id, version).c_str());
    }
    transaction.commit();
  }
}

JournalPlace FindingStore::folded() {
  Statement place = database_.prepare("SELECT identity, bytes, lines FROM journal");
  if (!place.step() || place.text(0) != journal_.identity())
    database_.fail_as_damaged(fmt::format("was made from another journal than {}", journal_.path()));
  return {static_cast<std::uint64_t>(place.integer(1)), static_cast<std::uint64_t>(place.integer(2))};
}

std::vector<std::string> FindingStore::catch_up(Damaged lines) {
  if (folded().bytes == journal_.end()) return {};
  std::vector<std::string> warnings;
  Transaction transaction(database_);
  JournalPlace place = folded();
  if (place.bytes > journal_.end())
    database_.fail_as_damaged(fmt::format("holds more than its journal {}, which has been cut off", journal_.path()));
  Fold fold(database_);
  EventReader reader;
  journal_.read(place, [&](std::string_view line, JournalPlace behind) {
    place = behind;
    try {
      const Event event = reader.read(line);
      std::visit([&](const auto& e) { fold.apply(e, whole(behind.lines)); }, event);
    } catch (const InputError& error) {
      const std::string what = fmt::format("{}:{}: {}", journal_.path(), behind.lines, error.what());
      if (lines == Damaged::refused)
        throw InputError(fmt::format("{}; {} goes on without this line", what, rebuild_command(path_)));
      warnings.push_back(what);
    }
  });
  database_.prepare("UPDATE journal SET bytes = ?, lines = ?").with(whole(place.bytes), whole(place.lines)).run();
  transaction.commit();
  return warnings;
}

std::vector<FindingRow> FindingStore::rows(const RowFilter& filter) {
  catch_up();
  std::string where = "true";
  if (filter.only_open) where += " AND status = 'open'";
  if (filter.only_new) where += " AND is_new";
  if (!filter.tracer.empty()) where += " AND tracer = ?1";
  return select(where, filter);
}

std::optional<FindingRow> FindingStore::row(std::int64_t id) {
  catch_up();
  auto found = select(fmt::format("id = {}", id), {});
  return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

std::vector<FindingRow> FindingStore::select(const std::string& where, const RowFilter& filter) {
  std::vector<FindingRow> rows;
  Statement from = database_.prepare(fmt::format("{}{}{}", select_findings, where, worst_first));
  if (filter.tracer.empty())
    from.with();
  else
    from.with(filter.tracer);
  while (from.step()) {
    FindingRow& row = rows.emplace_back();
    row.id = from.integer(0);
    row.tracer = from.text(1);
    row.signature = from.text(2);
    row.kind = from_name<FindingKind>(finding_kind_names, from.text(3)).value_or(FindingKind::false_miss);
    row.element = from_name<Element>(element_names, from.text(4)).value_or(Element::none);
    row.conditioning = from_name<Conditioning>(conditioning_names, from.text(5)).value_or(Conditioning::nominal);
    row.count = static_cast<std::uint64_t>(from.integer(6));
    row.first_seen = from.text(7);
    row.last_seen = from.text(8);
    row.status = from_name<FindingStatus>(finding_status_names, from.text(9)).value_or(FindingStatus::open);
    row.duplicate_of = from.integer(10);
    row.is_new = from.integer(11) != 0;
    row.worst = {.ulps = from.real(12), .bits = static_cast<unsigned>(from.integer(13)), .what = {}};
    row.simplest = {.ulps = from.real(14), .bits = static_cast<unsigned>(from.integer(15)), .what = {}};
  }
  if (!filter.details) return rows;
  Statement builds = database_.prepare("SELECT build FROM build WHERE finding = ? ORDER BY build");
  for (FindingRow& row : rows) {
    builds.with(row.id);
    while (builds.step()) row.builds.push_back(builds.text(0));
    row.worst.what = example(row, "worst", row.worst.ulps);
    row.simplest.what = example(row, "simplest", row.simplest.ulps);
  }
  return rows;
}

Case FindingStore::example(const FindingRow& row, std::string_view which, double ulps) {
  Statement from = database_.prepare("SELECT found, text FROM example WHERE finding = ? AND which = ?");
  if (!from.with(row.id, which).step())
    database_.fail_as_damaged(fmt::format("finding {} has lost its {} case", row.id, which));
  Case what = cases_.read(from.text(1));
  what.id = row.signature;
  what.provenance = {fmt::format("{} of {}", name(row.kind), printable(row.tracer)),
                     severity_text(ulps, row.conditioning), from.text(0)};
  set_finding(what, row.tracer, row.kind);
  return what;
}

std::vector<SearchRow> FindingStore::searches() {
  catch_up();
  std::vector<SearchRow> rows;
  Statement from = database_.prepare(
      "SELECT tracer, source, ended, executions, worst_nominal_ulps, least_margin_ulps, signatures FROM search ORDER "
      "BY line");
  while (from.step())
    rows.push_back({.tracer = from.text(0),
                    .source = from.text(1),
                    .ended = from.text(2),
                    .executions = static_cast<std::uint64_t>(from.integer(3)),
                    .worst_nominal_ulps = from.real(4),
                    .least_margin_ulps = from.real(5),
                    .signatures = static_cast<std::uint64_t>(from.integer(6))});
  return rows;
}

void FindingStore::tell(const Event& event) {
  journal_.tell(event);
  catch_up();
}

FindingName FindingStore::name_of(std::int64_t id) {
  Statement from = database_.prepare("SELECT tracer, signature FROM finding WHERE id = ?");
  if (!from.with(id).step())
    throw InputError(fmt::format("{}: no finding {}; 'plumbline triage {}' lists them", path_, id, path_));
  return {from.text(0), from.text(1)};
}

void FindingStore::set_status(std::int64_t id, FindingStatus status, std::int64_t duplicate_of,
                              const std::string& by) {
  catch_up();
  StatusSet set{.finding = name_of(id), .status = status, .duplicate_of = {}, .by = by, .set = {}};
  if (status == FindingStatus::duplicate) {
    if (id == duplicate_of)
      throw InputError(fmt::format("finding {} can't be a duplicate of itself; name another", id));
    set.duplicate_of = name_of(duplicate_of);
  }
  tell(set);
}

std::vector<std::string> rebuild(const std::string& path) {
  const std::string made = fmt::format("{}.new.{}", path, getpid());
  const auto remove = [&made] {
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(made + suffix, ignored);
  };
  std::vector<std::string> warnings;
  remove();
  try {
    FindingStore store(path, made, Open::existing);
    store.prepare_schema();
    warnings = store.catch_up(FindingStore::Damaged::skipped);
    store.database_.run("PRAGMA journal_mode = DELETE");  // all in one file, to be renamed
  } catch (...) {
    remove();
    throw;
  }
  std::error_code error;
  for (const char* suffix : {"-wal", "-shm", ""})
    if (fs::exists(path + suffix)) fs::rename(path + suffix, path + ".old" + suffix, error);
  fs::rename(made, path, error);
  if (error)
    throw InputError(
        fmt::format("{}: can't be put in place: {}; the new database is {}", path, error.message(), made));
  return warnings;
}

}  // namespace plumbline
