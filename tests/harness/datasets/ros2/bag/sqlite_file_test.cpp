// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/sqlite_file.h"

#include <gmock/gmock.h>
#include <sqlite3.h>

#include "harness/datasets/ros2/mcap/mcap_file.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kTopics =
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT,"
    " offered_qos_profiles TEXT);"
    "INSERT INTO topics VALUES (1, '/a', 'A', 'cdr', ''), (2, '/b', 'B', 'json', '');";
constexpr const char* kMessages =
    "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data "
    "BLOB);";

class SqliteFileTest : public testing::Test {
 protected:
  fs::path database(const std::string& sql, const std::string& name = "a.db3") const {
    const fs::path file = folder_ / name;
    fs::remove(file);
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    sqlite3_close(database);
    return file;
  }
  static std::vector<std::string> messages(BagFile& in) {
    std::vector<std::string> found;
    std::vector<std::pair<MessagePlace, std::string>> places;
    in.scan([&](const BagMessage& m) {
      found.push_back(fmt::format("{} {} {}", m.topic, m.type, m.data));
      places.emplace_back(m.place, m.data);
    });
    for (const auto& [place, data] : places) EXPECT_EQ(in.read(place), data);
    return found;
  }
  std::string problem(const fs::path& file) const {
    const std::string error = error_of([&] {
      SqliteFile in(file);
      messages(in);
    });
    EXPECT_THAT(error, HasSubstr(file.string()));
    return error;
  }
  test::TestFolder folder_;
};

TEST_F(SqliteFileTest, MessagesInCdrAreReadInOrder) {
  const fs::path file = database(
      std::string(kTopics) + kMessages +
          "INSERT INTO messages VALUES (7, 1, 20, x'78'), (3, 1, 10, x'797a'), (5, 2, 11, x'00');",
      "a bag?immutable=0.db3");  // a name that would be an option in a URI
  SqliteFile in(file);
  EXPECT_THAT(messages(in), ElementsAre("/a A yz", "/a A x"));
  EXPECT_EQ(in.describe({.block = 3}), "row 3 of messages");
  std::vector<fs::path> entries(fs::directory_iterator(folder_.path()), {});
  EXPECT_EQ(entries.size(), 1u);  // nothing was written beside it
}

/// The same bag as an MCAP file.
TEST_F(SqliteFileTest, ABagOfTheCorpusIsThatOfMcap) {
  const fs::path corpus = fs::path(VINEBENCH_SOURCE_DIR) / "tests/fuzz/corpus";
  SqliteFile in(corpus / "db3/small");
  McapFile same(corpus / "mcap/plain");
  EXPECT_EQ(messages(in), messages(same));
}

TEST_F(SqliteFileTest, WhatIsNoBagIsAnError) {
  EXPECT_THAT(problem(folder_.write("text.db3", "no database, but long enough to look for one")),
              HasSubstr("SQLite: file is not a database"));
  EXPECT_THAT(problem(folder_ / "none.db3"), HasSubstr("No such file"));
  EXPECT_THAT(problem(database(kTopics)), HasSubstr("tables 'topics' and 'messages'"));
  EXPECT_THAT(problem(database(std::string(kTopics) + "CREATE TABLE messages(id INTEGER);")),
              HasSubstr("SQLite: no such column"));
}

/// A view can compute for ever.
TEST_F(SqliteFileTest, AViewInPlaceOfATableIsAnError) {
  EXPECT_THAT(problem(database(std::string(kTopics) +
                               "CREATE VIEW messages AS WITH RECURSIVE n(id) AS (SELECT 1 UNION "
                               "ALL SELECT id + 1 FROM n) SELECT id, 1 AS topic_id, 0 AS "
                               "timestamp, x'00' AS data FROM n;")),
              HasSubstr("tables 'topics' and 'messages'"));
}

TEST_F(SqliteFileTest, BrokenRowsAreErrors) {
  EXPECT_THAT(problem(database(std::string(kTopics) + kMessages +
                               "INSERT INTO messages VALUES (4, 9, 0, x'00');")),
              HasSubstr("row 4 of messages: expected one of the topics, found 9"));
  const fs::path file = database(std::string(kTopics) + kMessages +
                                 "INSERT INTO messages VALUES (1, 1, 0, zeroblob(50000));");
  std::string bytes = read_file(file);
  std::fill(bytes.begin() + 4096, bytes.end(), '\x11');  // all pages but the first
  EXPECT_THAT(problem(folder_.write("broken.db3", bytes)), HasSubstr("SQLite: "));
}

}  // namespace
}  // namespace vinebench::harness
