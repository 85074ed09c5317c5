// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// SQLite with a rollback journal and synchronous = EXTRA: a commit returns when file, journal and
// the folder's entry are on the disk, whoever is killed next.
#include "tool/label_store.h"

#include <sqlite3.h>

#include <filesystem>

namespace vsprite {
namespace {

constexpr int kApplicationId = 0x7673706C;  // "vspl"
constexpr int kVersion = 1;
constexpr int kBusyMilliseconds = 2000;
constexpr std::uintmax_t kSmallest = 512;  // bytes of a page

constexpr const char* kSchema =
    "CREATE TABLE answers("
    "id INTEGER PRIMARY KEY AUTOINCREMENT,"
    "film_a TEXT NOT NULL, frame_a INTEGER NOT NULL, mirrored_a INTEGER NOT NULL,"
    "film_b TEXT NOT NULL, frame_b INTEGER NOT NULL, mirrored_b INTEGER NOT NULL,"
    "acceptable INTEGER NOT NULL, at_random INTEGER NOT NULL,"
    "guess REAL NOT NULL,"
    "taken_back INTEGER NOT NULL DEFAULT 0);"
    "PRAGMA application_id = 1987276908;"  // kApplicationId
    "PRAGMA user_version = 1";
static_assert(kApplicationId == 1987276908 && kVersion == 1);

#define VSPRITE_ANSWER_COLUMNS \
  "film_a, frame_a, mirrored_a, film_b, frame_b, mirrored_b, acceptable, at_random, guess"

/// A statement that is finalised with its scope.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql) {
    code_ = sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr);
  }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement() { sqlite3_finalize(statement_); }
  bool ready() const { return code_ == SQLITE_OK; }
  int step() { return sqlite3_step(statement_); }
  void reset() { sqlite3_reset(statement_); }
  sqlite3_stmt* get() const { return statement_; }

 private:
  sqlite3_stmt* statement_ = nullptr;
  int code_;
};

void bind(Statement& statement, int at, const SampleName& name) {
  sqlite3_bind_text(statement.get(), at, name.film.c_str(), -1, SQLITE_TRANSIENT);
  sqlite3_bind_int(statement.get(), at + 1, name.frame);
  sqlite3_bind_int(statement.get(), at + 2, name.mirrored ? 1 : 0);
}

SampleName read_name(const Statement& statement, int at) {
  const unsigned char* film = sqlite3_column_text(statement.get(), at);
  return {film != nullptr ? reinterpret_cast<const char*>(film) : "",
          sqlite3_column_int(statement.get(), at + 1),
          sqlite3_column_int(statement.get(), at + 2) != 0};
}

Answer read_answer(const Statement& statement) {
  return {read_name(statement, 0), read_name(statement, 3),
          sqlite3_column_int(statement.get(), 6) != 0, sqlite3_column_int(statement.get(), 7) != 0,
          sqlite3_column_double(statement.get(), 8)};
}

}  // namespace

void LabelStore::Close::operator()(sqlite3* database) const noexcept { sqlite3_close(database); }

LabelStore::LabelStore(std::string path, std::unique_ptr<sqlite3, Close> database)
    : path_(std::move(path)), database_(std::move(database)) {}

Error LabelStore::damaged(const std::string& how) const {
  return {ErrorCode::CorruptData,
          path_ + ": damaged (" + how +
              "): put a copy back, or move it away and import a CSV with --answers"};
}

/// What SQLite's last complaint means to a person.
Error LabelStore::fault(const char* doing) const {
  const std::string said = sqlite3_errmsg(database_.get());
  switch (sqlite3_errcode(database_.get())) {
    case SQLITE_NOTADB:
      return {ErrorCode::BadFormat,
              path_ + ": is no database of labels (" + said + "): move it away"};
    case SQLITE_CORRUPT:
      return damaged(said);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {ErrorCode::InUse, path_ + ": is in use by another program: close it and try again"};
    case SQLITE_CANTOPEN:
      return {ErrorCode::CannotCreate, path_ + ": cannot be opened or created: " + said};
    case SQLITE_PERM:
    case SQLITE_READONLY:
    case SQLITE_FULL:
    case SQLITE_IOERR:
      return {ErrorCode::CannotWrite,
              path_ + ": cannot be " + doing + " (" + said +
                  "): make room on the disk or check its permissions; every answer that was "
                  "acknowledged is kept"};
    default:
      return {ErrorCode::CannotRead, path_ + ": cannot be " + doing + ": " + said};
  }
}

Result<void> LabelStore::run(const char* sql) {
  if (sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK)
    return fault("written");
  return {};
}

Result<LabelStore> LabelStore::open(const std::string& path) {
  std::error_code absent;
  const auto bytes = std::filesystem::file_size(path, absent);
  if (!absent && bytes > 0 && bytes < kSmallest)  // SQLite would take it for an empty one
    return Error{ErrorCode::BadFormat, path + ": is no database of labels (" +
                                           std::to_string(bytes) + " bytes): move it away"};
  sqlite3* raw = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int code = sqlite3_open_v2(path.c_str(), &raw, flags, nullptr);
  LabelStore store(path, std::unique_ptr<sqlite3, Close>(raw));
  if (code != SQLITE_OK) return store.fault("opened");
  sqlite3_busy_timeout(raw, kBusyMilliseconds);
  if (auto ready = store.prepare(); !ready) return ready.error();
  return store;
}

/// All that `change` does, or nothing.
template <class Change>
Result<void> LabelStore::transaction(Change change) {
  if (auto begun = run("BEGIN IMMEDIATE"); !begun) return begun;
  Result<void> done = change();
  if (done) done = run("COMMIT");
  // After a full disk SQLite has rolled back by itself; then this does nothing.
  if (!done) sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
  return done;
}

/// SQLite reads a file that was cut off without a word where the cut spares its tree.
Result<void> LabelStore::check_whole() {
  Statement check(database_.get(), "PRAGMA quick_check(1)");
  Statement size(database_.get(),
                 "SELECT page_count * page_size FROM pragma_page_count, pragma_page_size");
  if (!check.ready() || check.step() != SQLITE_ROW || !size.ready() || size.step() != SQLITE_ROW)
    return fault("read");
  const std::string said = reinterpret_cast<const char*>(sqlite3_column_text(check.get(), 0));
  std::error_code ignored;
  const auto bytes = std::filesystem::file_size(path_, ignored);
  const auto due = static_cast<std::uintmax_t>(sqlite3_column_int64(size.get(), 0));
  if (said == "ok" && bytes == due) return {};
  return damaged(said == "ok"
                     ? std::to_string(bytes) + " bytes where " + std::to_string(due) + " are due"
                     : said);
}

/// Checks whose file it is, and makes the table in an empty one.
Result<void> LabelStore::prepare() {
  const auto number = [this](const char* sql, int& value) {
    Statement statement(database_.get(), sql);
    if (!statement.ready() || statement.step() != SQLITE_ROW) return false;
    value = sqlite3_column_int(statement.get(), 0);
    return true;
  };
  int application = 0, version = 0, tables = 0;
  if (!number("PRAGMA application_id", application) || !number("PRAGMA user_version", version) ||
      !number("SELECT count(*) FROM sqlite_master", tables))
    return fault("read");
  if (tables > 0 && application != kApplicationId)
    return Error{ErrorCode::BadFormat, path_ + ": is a database of another program: move it away"};
  if (version > kVersion)
    return Error{ErrorCode::UnsupportedVersion,
                 path_ + ": version " + std::to_string(version) + " where this vsprite reads " +
                     std::to_string(kVersion) +
                     ": use the newer vsprite that made it, or its `label --export`"};
  if (auto set = run("PRAGMA journal_mode = DELETE; PRAGMA synchronous = EXTRA"); !set) return set;
  if (tables > 0) return check_whole();
  return transaction([this] { return run(kSchema); });
}

Result<std::vector<Answer>> LabelStore::select(const char* sql) const {
  Statement statement(database_.get(), sql);
  if (!statement.ready()) return fault("read");
  std::vector<Answer> found;
  int code = 0;
  while ((code = statement.step()) == SQLITE_ROW) found.push_back(read_answer(statement));
  if (code != SQLITE_DONE) return fault("read");
  return found;
}

Result<std::vector<Answer>> LabelStore::answers() const {
  return select("SELECT " VSPRITE_ANSWER_COLUMNS " FROM answers WHERE taken_back = 0 ORDER BY id");
}

Result<void> LabelStore::insert(std::span<const Answer> answers) {
  Statement statement(database_.get(), "INSERT INTO answers(" VSPRITE_ANSWER_COLUMNS
                                       ") VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)");
  if (!statement.ready()) return fault("written");
  for (const Answer& answer : answers) {
    bind(statement, 1, answer.a);
    bind(statement, 4, answer.b);
    sqlite3_bind_int(statement.get(), 7, answer.acceptable ? 1 : 0);
    sqlite3_bind_int(statement.get(), 8, answer.at_random ? 1 : 0);
    sqlite3_bind_double(statement.get(), 9, answer.guess);
    if (statement.step() != SQLITE_DONE) return fault("written");
    statement.reset();
  }
  return {};
}

Result<void> LabelStore::add(std::span<const Answer> answers) {
  return transaction([&]() -> Result<void> {
    if (auto done = run("DELETE FROM answers WHERE taken_back = 1"); !done) return done;
    return insert(answers);
  });
}

Result<std::optional<Answer>> LabelStore::mark(const char* find, const char* update) {
  const auto found = select(find);
  if (!found) return found.error();
  if (found->empty()) return std::optional<Answer>{};
  if (auto done = run(update); !done) return done.error();
  return std::optional<Answer>(found->front());
}

Result<std::optional<Answer>> LabelStore::undo() {
  return mark("SELECT " VSPRITE_ANSWER_COLUMNS
              " FROM answers WHERE taken_back = 0 ORDER BY id DESC LIMIT 1",
              "UPDATE answers SET taken_back = 1 WHERE id = "
              "(SELECT max(id) FROM answers WHERE taken_back = 0)");
}

Result<std::optional<Answer>> LabelStore::redo() {
  return mark("SELECT " VSPRITE_ANSWER_COLUMNS
              " FROM answers WHERE taken_back = 1 ORDER BY id LIMIT 1",
              "UPDATE answers SET taken_back = 0 WHERE id = "
              "(SELECT min(id) FROM answers WHERE taken_back = 1)");
}

}  // namespace vsprite
