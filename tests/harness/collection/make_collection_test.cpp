// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/collection/make_collection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "harness/datasets/format/dataset_card.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

CollectionSequence sequence(const std::string& name, std::int64_t seed) {
  CollectionSequence made;
  made.name = name;
  made.scenario = std::string(VINEBENCH_SOURCE_DIR) + "/scenarios/quick-loop.yaml";
  made.seed = seed;
  made.set = {{"renderer.engine", "fake"}, {"duration", "0.2"}};
  return made;
}

class MakeCollectionTest : public testing::Test {
 protected:
  MakeCollectionTest() {
    request_.out = folder_.path();
    request_.options.formats = {"tum"};
    request_.progress = &progress_;
  }
  std::vector<MadeSequence> make(const std::vector<CollectionSequence>& sequences) {
    request_.sequences = sequences;
    return make_sequences(request_);
  }

  test::TestFolder folder_;
  std::ostringstream progress_;
  CollectionRequest request_;
};

TEST_F(MakeCollectionTest, TheHashIsThatOfTheFramesWhateverTheFormat) {
  request_.jobs = 2;
  const auto made = make({sequence("a", 1), sequence("b", 2)});
  ASSERT_EQ(made.size(), 2u);
  EXPECT_EQ(made[0].error, "");
  EXPECT_EQ(made[0].hash.size(), 32u);
  EXPECT_NE(made[0].hash, made[1].hash);
  EXPECT_FALSE(made[0].environment.empty());
  EXPECT_EQ(read_card(folder_ / "train/a").frames_xxh128, made[0].hash);
  EXPECT_THAT(progress_.str(), HasSubstr("a: new\n"));

  // Kept; and again in another folder with another format.
  EXPECT_EQ(make({sequence("a", 1)})[0].hash, made[0].hash);
  EXPECT_TRUE(make({sequence("a", 1)})[0].environment.empty());
  request_.out = folder_ / "again";
  request_.options.formats = {"euroc"};
  EXPECT_EQ(make({sequence("a", 1)})[0].hash, made[0].hash);
}

TEST_F(MakeCollectionTest, OneThatCannotBeMadeDoesNotEndTheOthers) {
  CollectionSequence bad = sequence("bad", 1);
  bad.set["slam.colour"] = "red";
  const auto made = make({bad, sequence("a", 1)});
  EXPECT_THAT(made[0].error, HasSubstr("slam.colour: unknown key"));
  EXPECT_EQ(judge_sequence(bad, made[0]), SequenceVerdict::kError);
  EXPECT_NE(made[1].hash, "");
}

TEST_F(MakeCollectionTest, OtherFramesAreSaidToBeOthers) {
  CollectionSequence told = sequence("a", 1);
  EXPECT_EQ(judge_sequence(told, {.hash = "00ff"}), SequenceVerdict::kNew);
  told.frames_xxh128 = "00ff";
  EXPECT_EQ(judge_sequence(told, {.hash = "00ff"}), SequenceVerdict::kSame);
  EXPECT_EQ(judge_sequence(told, {.hash = "00fe"}), SequenceVerdict::kDifferent);
  EXPECT_EQ(judge_sequence(told, {}), SequenceVerdict::kMissing);
}

}  // namespace
}  // namespace vinebench::harness
