// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/depth/depth_format.h"

#include <gmock/gmock.h>

#include "core/truth/labels.h"
#include "tests/support/label_folder.h"

namespace vinebench::harness {
namespace {

using test::LabelFolder;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(DepthFormatTest, MillimetresAreRoundedAndEndAt16Bits) {
  const cv::Mat depth = (cv::Mat_<float>(1, 5) << 0, 1.2344f, 1.2346f, 65.535f, 65.536f);
  const cv::Mat codes = millimetres(depth);
  // 2^16 - 1 mm is the most that a code has; beyond it is "none".
  EXPECT_THAT(std::vector<int>(codes.begin<std::uint16_t>(), codes.end<std::uint16_t>()),
              ElementsAre(0, 1234, 1235, 65535, 0));
}

TEST(DepthFormatTest, TheSkyHasNone) {
  LabelFolder folder;
  cv::Mat semantic = LabelFolder::filled(CV_8UC1, static_cast<int>(Label::kGround));
  semantic.col(2).setTo(static_cast<int>(Label::kSky));
  folder.put("semantic", semantic);
  cv::Mat depth = LabelFolder::filled(CV_16UC1, 900);
  depth.col(2).setTo(0);
  folder.put("depth", depth);
  EXPECT_THAT(folder.faults_of(depth_format().check_image), IsEmpty());
  depth.at<std::uint16_t>(1, 2) = 900;
  folder.put("depth", depth);
  EXPECT_THAT(folder.faults_of(depth_format().check_image),
              ElementsAre("depth/left/000000.png: has depth in the sky at 1 pixels"));
}

}  // namespace
}  // namespace vinebench::harness
