// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/collection/collection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/collection/commitment.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;

constexpr const char* kText = R"(# A comment.

name: two
sequences:
  - {name: a, scenario: row, seed: 3, set: {duration: 2}}
  - {name: b, split: test, scenario: row, seed: 4, frames_xxh128: "00ff"}
)";

class CollectionTest : public testing::Test {
 protected:
  Collection read(const std::string& text) const {
    return read_collection(folder_.write("two.yaml", text));
  }

  test::TestFolder folder_;
};

TEST_F(CollectionTest, IsWrittenAsItIsRead) {
  const Collection collection = read(kText);
  ASSERT_EQ(collection.sequences.size(), 2u);
  EXPECT_EQ(collection.sequences[0].split, "train");
  EXPECT_EQ(collection.sequences[0].set.at("duration"), "2");
  const std::string text = format_collection(collection, kText);
  EXPECT_THAT(text, testing::StartsWith("# A comment.\n\nname: "));
  EXPECT_EQ(format_collection(read(text), text), text);
  EXPECT_EQ(read(text).sequences[1].frames_xxh128, "00ff");
}

TEST_F(CollectionTest, BadOnesAreRefused) {
  const auto error = [&](const std::string& sequences) {
    return error_of([&] { read("name: two\nsequences: [" + sequences + "]\n"); });
  };
  EXPECT_THAT(error(""), HasSubstr("sequences: expected at least one"));
  EXPECT_THAT(error("{name: a, scenario: row, seed: 1}, {name: a, scenario: row, seed: 2}"),
              HasSubstr("two of the sequences have the name 'a'"));
  EXPECT_THAT(error("{name: a, scenario: row}"), HasSubstr("either a seed or a commitment"));
  EXPECT_THAT(error("{name: a, scenario: row, seed: 1, commitment: ff}"),
              HasSubstr("either a seed or a commitment"));
  EXPECT_THAT(error("{name: ../a, scenario: row, seed: 1}"), HasSubstr("begins with no '.'"));
  EXPECT_THAT(error("{name: a, split: b/c, scenario: row, seed: 1}"), HasSubstr("has no '/'"));
  EXPECT_THAT(error("{name: a, scenario: row, sed: 1}"), HasSubstr("sed: unknown key"));
}

TEST_F(CollectionTest, SealedSeedsComeBack) {
  Collection collection = read(kText);
  const std::string before = format_collection(collection, "");
  const CollectionSecrets secrets = seal(collection, "test", "salt");
  EXPECT_TRUE(collection.sequences[0].seed);  // of another split
  EXPECT_FALSE(collection.sequences[1].seed);
  EXPECT_EQ(collection.sequences[1].commitment, commitment_of("salt", "b", 4));
  EXPECT_EQ(format_collection(collection, "").find("seed: 4"), std::string::npos);
  const std::string published = format_collection(collection, "");
  Collection opened = read(published);
  unseal(opened, secrets);
  EXPECT_EQ(format_collection(opened, ""), before);
}

TEST_F(CollectionTest, AnotherSeedThanCommittedToIsRefused) {
  Collection collection = read(kText);
  CollectionSecrets secrets = seal(collection, "test", "salt");
  secrets.seeds["b"] = 5;
  EXPECT_THAT(error_of([&] { unseal(collection, secrets); }),
              HasSubstr("sequence b: seed 5 is not the one that was committed to"));
  secrets.seeds["b"] = 4;
  secrets.salt = "other";
  EXPECT_NE(error_of([&] { unseal(collection, secrets); }), "");
}

}  // namespace
}  // namespace vinebench::harness
