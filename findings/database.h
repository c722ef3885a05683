// SQLite, as far as a store needs it. Throws InputError: with the fix for a file that is damaged or none of SQLite's,
// where the disk is full, where another process holds it for a minute.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace plumbline {

class Database;

/// A statement of SQL, used as often as wanted.
class Statement {
 public:
  /// Begins anew with these values for the question marks.
  template <class... Values>
  Statement& with(const Values&... values) {
    reset();
    int at = 0;
    (bind(++at, values), ...);
    return *this;
  }
  /// Steps to the next row; false behind the last.
  bool step();
  /// Steps through to the end.
  void run();

  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;  ///< of any bytes

 private:
  friend class Database;
  Statement(Database& database, std::string_view sql);
  void reset();
  void bind(int at, std::int64_t value);
  void bind(int at, double value);
  void bind(int at, std::string_view value);

  Database* database_;
  std::shared_ptr<sqlite3_stmt> statement_;
};

class Database {
 public:
  /// Opens the file, and makes it where there is none. `damage_fix` is what a message advises for a file that is no
  /// good, `full_fix` where it can't be written.
  Database(std::string path, std::string damage_fix, std::string full_fix);

  void run(const char* sql);
  Statement prepare(std::string_view sql) { return {*this, sql}; }
  std::int64_t integer(std::string_view sql);  ///< the one that it selects
  /// Of rows, by the statement run last.
  int changes() const;

  /// "PATH: what; the fix for damage"
  [[noreturn]] void fail_as_damaged(std::string_view what) const;

 private:
  friend class Statement;
  friend class Transaction;
  void check(int result) const;

  std::string path_, damage_fix_, full_fix_;
  std::shared_ptr<sqlite3> database_;
};

/// Ended by commit(); without, nothing has happened. Waits for other writers.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(&database) { database.run("BEGIN IMMEDIATE"); }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database* database_;
};

}  // namespace plumbline
