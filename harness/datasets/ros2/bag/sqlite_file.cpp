// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/sqlite_file.h"

#include <sqlite3.h>

#include <optional>

#include "core/files/input_file.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kMostTopics = 65535;  // as in MCAP

/// As a URI: SQLite's options are in it, and all else in a name must not be taken for one.
std::string uri_of(const std::filesystem::path& file, bool immutable) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789/-_.~";
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(file).string()) {
    if (kPlain.find(c) != std::string_view::npos) {
      uri += c;
    } else {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return uri + (immutable ? "?immutable=1" : "");
}

std::string text_at(sqlite3_stmt* row, int column) {
  const unsigned char* text = sqlite3_column_text(row, column);
  const int size = sqlite3_column_bytes(row, column);
  return text == nullptr ? "" : std::string(reinterpret_cast<const char*>(text), size);
}

std::string_view blob_at(sqlite3_stmt* row, int column) {
  const void* blob = sqlite3_column_blob(row, column);
  const int size = sqlite3_column_bytes(row, column);
  if (blob == nullptr) return {};
  return {static_cast<const char*>(blob), static_cast<std::size_t>(size)};
}

}  // namespace

void SqliteFile::Finalise::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

SqliteFile::SqliteFile(const std::filesystem::path& file) : name_(file) {
  check_input_file(name_, FileKind::kPart);
  try {
    open();
  } catch (const Error&) {
    sqlite3_close_v2(database_);
    throw;
  }
}

SqliteFile::~SqliteFile() {
  message_.reset();
  sqlite3_close_v2(database_);
}

/// Where no log of a writer is beside it, nothing is written beside it either.
void SqliteFile::open() {
  const bool immutable = !is_present(name_.string() + "-wal");
  constexpr int kFlags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX;
  if (sqlite3_open_v2(uri_of(name_, immutable).c_str(), &database_, kFlags, nullptr) != SQLITE_OK) {
    fault();
  }
  // What SQLite's page "Defense Against The Dark Arts" recommends for files of strangers.
  sqlite3_db_config(database_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database_, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(database_, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(database_, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_limit(database_, SQLITE_LIMIT_LENGTH, static_cast<int>(kMostMessageBytes));
  step(prepare("PRAGMA cell_size_check=ON").get());
  step(prepare("PRAGMA mmap_size=0").get());
  expect_tables();
  const Statement rows = prepare("SELECT id, name, type, serialization_format FROM topics");
  while (step(rows.get())) {
    if (topics_.size() >= kMostTopics) {
      fail("{}: expected at most {} topics", name_.string(), kMostTopics);
    }
    topics_[sqlite3_column_int64(rows.get(), 0)] = {text_at(rows.get(), 1), text_at(rows.get(), 2),
                                                    text_at(rows.get(), 3) == "cdr"};
  }
}

/// Tables and no more: a view or a virtual table could compute for ever.
void SqliteFile::expect_tables() const {
  const Statement tables = prepare(
      "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND rootpage > 0 AND name IN "
      "('topics', 'messages')");
  if (!step(tables.get()) || sqlite3_column_int64(tables.get(), 0) != 2) {
    fail("{}: expected a bag of ROS 2: tables 'topics' and 'messages'", name_.string());
  }
}

SqliteFile::Statement SqliteFile::prepare(const char* sql) const {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_, sql, -1, &statement, nullptr) != SQLITE_OK) fault();
  return Statement(statement);
}

bool SqliteFile::step(sqlite3_stmt* statement) const {
  const int result = sqlite3_step(statement);
  if (result != SQLITE_ROW && result != SQLITE_DONE) fault();
  return result == SQLITE_ROW;
}

void SqliteFile::fault() const {
  fail("{}: SQLite: {}", name_.string(),
       database_ == nullptr ? "not enough memory" : sqlite3_errmsg(database_));
}

std::string SqliteFile::describe(const MessagePlace& place) const {
  return fmt::format("row {} of messages", place.block);
}

void SqliteFile::scan(const std::function<void(const BagMessage&)>& take) {
  const std::lock_guard lock(mutex_);
  std::uintmax_t left = InputFile(name_, FileKind::kPart).size();
  std::optional<std::int64_t> before;
  const Statement rows = prepare("SELECT rowid, topic_id, data FROM messages ORDER BY rowid");
  while (step(rows.get())) {
    MessagePlace place;
    place.block = static_cast<std::uint64_t>(sqlite3_column_int64(rows.get(), 0));
    // Pages that refer to each other in circles give rows without end.
    if (before && sqlite3_column_int64(rows.get(), 0) <= *before) {
      fail("{}: {}: expected rows in order", name_.string(), describe(place));
    }
    before = sqlite3_column_int64(rows.get(), 0);
    const auto topic = topics_.find(sqlite3_column_int64(rows.get(), 1));
    if (topic == topics_.end()) {
      fail("{}: {}: expected one of the topics, found {}", name_.string(), describe(place),
           sqlite3_column_int64(rows.get(), 1));
    }
    const std::string_view data = blob_at(rows.get(), 2);
    place.size = data.size();
    if (place.size > left) {
      fail("{}: {}: the data of all rows is larger than the file", name_.string(), describe(place));
    }
    left -= place.size;
    if (topic->second.cdr) take({topic->second.name, topic->second.type, data, place});
  }
}

std::string SqliteFile::read(const MessagePlace& place) const {
  const std::lock_guard lock(mutex_);
  if (message_ == nullptr) message_ = prepare("SELECT data FROM messages WHERE rowid = ?");
  sqlite3_reset(message_.get());
  sqlite3_bind_int64(message_.get(), 1, static_cast<std::int64_t>(place.block));
  if (!step(message_.get())) fail("{}: {}: is gone", name_.string(), describe(place));
  std::string data(blob_at(message_.get(), 0));
  sqlite3_reset(message_.get());
  return data;
}

}  // namespace vinebench::harness
