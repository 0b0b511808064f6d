// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/recorded_sequence.h"

#include <gmock/gmock.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

std::vector<std::string> problems(const RecordedSequence& sequence, std::size_t rows) {
  std::vector<DatasetFault> faults;
  expect_rows(sequence, "times.txt", rows, faults);
  std::vector<std::string> texts;
  for (const DatasetFault& fault : faults) texts.push_back(fault.file + " " + fault.problem);
  return texts;
}

TEST(RecordedSequenceTest, AListHasALineForEachFrame) {
  RecordedSequence sequence;
  sequence.frames.resize(3);
  EXPECT_THAT(problems(sequence, 3), testing::IsEmpty());
  EXPECT_THAT(problems(sequence, 4),
              testing::ElementsAre("times.txt has 4 lines, expected one for each of 3 frames"));
  EXPECT_EQ(problems(sequence, 2).size(), 1u);
  sequence.complete = false;  // the frame under way may be in the list already
  EXPECT_THAT(problems(sequence, 4), testing::IsEmpty());
  EXPECT_EQ(problems(sequence, 2).size(), 1u);
  EXPECT_EQ(problems(sequence, 5).size(), 1u);
}

TEST(RecordedSequenceTest, ALineThatWasCutOffIsOfAnInterruptionOnly) {
  const test::TestFolder folder;
  folder.write("list.csv", "#a,b\n1,2\n3,4\n5");
  RecordedSequence sequence;
  sequence.folder = folder.path();
  EXPECT_EQ(sequence.read("list.csv").size(), 3u);
  sequence.complete = false;
  EXPECT_EQ(sequence.read("list.csv").size(), 2u);
  folder.write("list.csv", "5");
  EXPECT_TRUE(sequence.read("list.csv").empty());
}

TEST(RecordedSequenceTest, KnowsWhatItHas) {
  const test::TestFolder folder;
  folder.write("frames.csv", "");
  RecordedSequence sequence;
  sequence.folder = folder.path();
  EXPECT_TRUE(sequence.has("frames.csv"));
  EXPECT_FALSE(sequence.has("coco"));
}

}  // namespace
}  // namespace vinebench::harness
