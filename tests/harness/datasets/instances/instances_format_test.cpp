// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/instances/instances_format.h"

#include <gmock/gmock.h>

#include "core/truth/labels.h"
#include "tests/support/label_folder.h"

namespace vinebench::harness {
namespace {

using test::LabelFolder;

TEST(InstancesFormatTest, BunchesAreWhereSemanticHasThem) {
  LabelFolder folder;
  // Number 5 + 256 * 2 (red, green): bunch 5 of plant 2; in OpenCV's order blue, green, red.
  folder.put("instances", LabelFolder::filled(CV_8UC3, {0, 2, 5}));
  cv::Mat semantic = LabelFolder::filled(CV_8UC1, static_cast<int>(Label::kBunch));
  folder.put("semantic", semantic);
  EXPECT_THAT(folder.faults_of(instances_format().check_image), testing::IsEmpty());
  semantic.row(1).setTo(static_cast<int>(Label::kLeaf));  // 4 pixels
  folder.put("semantic", semantic);
  EXPECT_THAT(folder.faults_of(instances_format().check_image),
              testing::ElementsAre("instances/left/000000.png: has bunches where semantic has "
                                   "none at 4 pixels"));
}

}  // namespace
}  // namespace vinebench::harness
