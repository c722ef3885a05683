#include "findings/database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <utility>

#include "case/input_error.h"

namespace plumbline {
namespace {

constexpr int patience_ms = 60'000;

}  // namespace

Database::Database(std::string path, std::string damage_fix, std::string full_fix)
    : path_(std::move(path)), damage_fix_(std::move(damage_fix)), full_fix_(std::move(full_fix)) {
  sqlite3* opened = nullptr;
  const int result = sqlite3_open_v2(path_.c_str(), &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  database_.reset(opened, sqlite3_close);
  check(result);
  sqlite3_extended_result_codes(opened, 1);
  sqlite3_busy_timeout(opened, patience_ms);
}

void Database::run(const char* sql) { check(sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr)); }

std::int64_t Database::integer(std::string_view sql) {
  Statement statement = prepare(sql);
  return statement.step() ? statement.integer(0) : 0;
}

int Database::changes() const { return sqlite3_changes(database_.get()); }

void Database::check(int result) const {
  const int code = result & 0xff;
  if (code == SQLITE_OK || code == SQLITE_ROW || code == SQLITE_DONE) return;
  const std::string what = sqlite3_errmsg(database_.get());
  switch (code) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
    case SQLITE_ERROR:  // a table or column that isn't there
      fail_as_damaged(what);
    case SQLITE_FULL:
    case SQLITE_IOERR:
      throw InputError(fmt::format("{}: can't be written: {}; {}", path_, what, full_fix_));
    case SQLITE_BUSY:
      throw InputError(fmt::format("{}: another process has been writing for a minute; try again", path_));
    default:
      throw InputError(fmt::format("{}: {}; name another file", path_, what));
  }
}

void Database::fail_as_damaged(std::string_view what) const {
  throw InputError(fmt::format("{}: {}; {}", path_, what, damage_fix_));
}

Statement::Statement(Database& database, std::string_view sql) : database_(&database) {
  sqlite3_stmt* made = nullptr;
  const int result =
      sqlite3_prepare_v2(database.database_.get(), sql.data(), static_cast<int>(sql.size()), &made, nullptr);
  statement_.reset(made, sqlite3_finalize);
  database.check(result);
}

void Statement::reset() {
  sqlite3_reset(statement_.get());
  sqlite3_clear_bindings(statement_.get());
}

bool Statement::step() {
  const int result = sqlite3_step(statement_.get());
  if (result == SQLITE_ROW) return true;
  sqlite3_reset(statement_.get());  // no lock stays behind
  database_->check(result);
  return false;
}

void Statement::run() {
  while (step()) {
  }
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }
double Statement::real(int column) const { return sqlite3_column_double(statement_.get(), column); }
std::string Statement::text(int column) const {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
  return {bytes ? bytes : "", static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

void Statement::bind(int at, std::int64_t value) {
  database_->check(sqlite3_bind_int64(statement_.get(), at, value));
}
void Statement::bind(int at, double value) { database_->check(sqlite3_bind_double(statement_.get(), at, value)); }
void Statement::bind(int at, std::string_view value) {
  database_->check(
      sqlite3_bind_text64(statement_.get(), at, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
}

Transaction::~Transaction() {
  // Where SQLite has rolled back by itself, there is nothing left to do.
  if (database_) sqlite3_exec(database_->database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_->run("COMMIT");
  database_ = nullptr;
}

}  // namespace plumbline
