// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/film_layout.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

namespace vinebench::harness {
namespace {

TEST(FilmLayoutTest, ImagesStandSideBySideEquallyHigh) {
  // 480 px to 240 is a half: 752 becomes 376; 1080 to 240: 1920 becomes 426.7.
  const FilmLayout layout({{"left", 752, 480}, {"side", 1920, 1080}});
  ASSERT_EQ(layout.cells().size(), 2u);
  EXPECT_EQ(layout.cells()[0].width, 376);
  EXPECT_EQ(layout.cells()[1].x, 376);
  EXPECT_EQ(layout.cells()[1].width, 427);
  EXPECT_EQ(layout.json()["width"], 803);
  EXPECT_EQ(layout.json()["cells"][1]["camera"], "side");
}

TEST(FilmLayoutTest, PixelsAreScaledAboutTheirCorners) {
  const FilmLayout layout({{"left", 752, 480}});
  // The image's left edge, -0.5, is the cell's; pixel 100's centre is 100.5 px from it: 50.25 -
  // 0.5.
  EXPECT_DOUBLE_EQ(layout.cells()[0].in_cell(-0.5), -0.5);
  EXPECT_DOUBLE_EQ(layout.cells()[0].in_cell(100), 49.8);  // to a tenth
}

TEST(FilmLayoutTest, APictureHasEachImageInItsCell) {
  const FilmLayout layout({{"red", 320, 240}, {"none", 320, 240}, {"grey", 640, 480}});
  const cv::Mat red(240, 320, CV_8UC3, cv::Scalar(255, 0, 0)), grey(480, 640, CV_8UC1, 100);
  const cv::Mat picture = cv::imdecode(layout.picture({red, {}, grey}), cv::IMREAD_COLOR);
  ASSERT_EQ(picture.size(), cv::Size(960, 240));
  const auto near = [&](int x, const cv::Vec3b& bgr) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.at<cv::Vec3b>(120, x)[c], bgr[c], 3) << x;
  };  // JPEG of quality 72 keeps an even colour to three codes
  near(160, {0, 0, 255});
  near(480, {0, 0, 0});
  near(800, {100, 100, 100});
}

}  // namespace
}  // namespace vinebench::harness
