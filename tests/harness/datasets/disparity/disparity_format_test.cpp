// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/disparity/disparity_format.h"

#include <gmock/gmock.h>

#include "tests/support/label_folder.h"

namespace vinebench::harness {
namespace {

using test::LabelFolder;
using testing::ElementsAre;
using testing::IsEmpty;

/// A right camera 0.2 m beside the left one: 10 px * 0.2 m / 2 m = 1 px, code 256.
class DisparityFormatTest : public testing::Test {
 protected:
  DisparityFormatTest() {
    Rig& rig = folder_.sequence().rig;
    RigCamera right = rig.cameras.front();
    right.T_body_cam.translation.y() -= 0.2;
    rig.cameras.push_back(right);
    rig.stereo_pairs = {{"front", 0, 1}};
    folder_.put("depth", LabelFolder::filled(CV_16UC1, 2000));
  }
  LabelFolder folder_;
};

TEST_F(DisparityFormatTest, AgreesWithDepth) {
  folder_.put("disparity", LabelFolder::filled(CV_16UC1, 256));
  EXPECT_THAT(folder_.faults_of(disparity_format().check_image), IsEmpty());
  cv::Mat wrong = LabelFolder::filled(CV_16UC1, 256);
  // Its own step is 1/256 px, and half a millimetre of 2 m a tenth of that: 3 steps are too many.
  wrong.at<std::uint16_t>(0, 0) = 259;
  folder_.put("disparity", wrong);
  EXPECT_THAT(folder_.faults_of(disparity_format().check_image),
              ElementsAre(testing::EndsWith("focal length · baseline / depth at 1 pixels")));
}

TEST_F(DisparityFormatTest, NoPairIsAnError) {
  RecordingNotes notes;
  const RecordOptions options;
  const SceneIndex scene;
  const test::TestFolder to;
  EXPECT_THAT(test::error_of([&] {
                disparity_format().write({to.path(), notes, scene, options});
              }),
              testing::HasSubstr("disparity: expected a stereo pair"));
}

}  // namespace
}  // namespace vinebench::harness
