// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>

#include "harness/datasets/ros2/bag/bag_file.h"

struct sqlite3;
struct sqlite3_stmt;

namespace vinebench::harness {

/// A file of a bag that ROS 2 keeps in SQLite: the tables `topics` and `messages`. It is opened
/// for reading alone, with SQLite's own settings against databases that are made to do harm.
class SqliteFile : public BagFile {
 public:
  explicit SqliteFile(const std::filesystem::path& file);
  ~SqliteFile() override;
  SqliteFile(const SqliteFile&) = delete;
  SqliteFile& operator=(const SqliteFile&) = delete;

  void scan(const std::function<void(const BagMessage&)>& take) override;
  std::string read(const MessagePlace& place) const override;
  std::string describe(const MessagePlace& place) const override;

 private:
  struct Topic {
    std::string name;
    std::string type;
    bool cdr = false;
  };
  struct Finalise {
    void operator()(sqlite3_stmt* statement) const;
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Finalise>;

  void open();
  void expect_tables() const;
  Statement prepare(const char* sql) const;
  /// Whether there is another row.
  bool step(sqlite3_stmt* statement) const;
  [[noreturn]] void fault() const;

  std::filesystem::path name_;
  sqlite3* database_ = nullptr;
  std::map<std::int64_t, Topic> topics_;
  mutable std::mutex mutex_;
  mutable Statement message_;  ///< one message by its row
};

}  // namespace vinebench::harness
