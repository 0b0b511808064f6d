// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/support/broken_png.h"
#include "tests/support/special_files.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

class ImageFileTest : public testing::Test {
 protected:
  std::string problem(const std::filesystem::path& file) const {
    const std::string error = error_of([&] { read_image(file, cv::IMREAD_UNCHANGED); });
    EXPECT_THAT(error, HasSubstr(file.string()));
    return error;
  }
  test::TestFolder folder_;
};

TEST_F(ImageFileTest, EveryFormatOfRecordingsIsRead) {
  const cv::Mat grey(5, 7, CV_8UC1, cv::Scalar(90));
  for (const char* name : {"a.png", "a.jpg", "a.pgm", "a.bmp", "a.tif", "a.webp"}) {
    cv::imwrite((folder_ / name).string(), grey);
    const cv::Mat image = read_image(folder_ / name, cv::IMREAD_GRAYSCALE);
    ASSERT_EQ(image.size(), grey.size()) << name;
    EXPECT_NEAR(image.at<std::uint8_t>(2, 3), 90, 1) << name;  // JPEG and WebP round
  }
}

TEST_F(ImageFileTest, WhatIsNoImageIsAnError) {
  EXPECT_THAT(problem(folder_.write("a.png", "text")), HasSubstr("expected an image"));
  EXPECT_THAT(problem(folder_.write("b.png", "")), HasSubstr("expected an image"));
  EXPECT_THAT(problem(test::make_pipe(folder_, "c.png")), HasSubstr("a pipe or a device"));
  EXPECT_THAT(problem(test::link_to_device(folder_, "d.png")), HasSubstr("a pipe or a device"));
  EXPECT_THAT(problem(folder_ / "none.png"), HasSubstr("No such file"));
}

TEST_F(ImageFileTest, AHeaderOfGigapixelsIsRefusedBeforeDecoding) {
  EXPECT_THAT(problem(folder_.write("a.png", test::png_of_size(40000, 40000))),
              HasSubstr("40000 x 40000"));
}

TEST_F(ImageFileTest, ADamagedImageIsEmpty) {
  const auto file = folder_.write("a.png", test::png_of_size(64, 48));
  EXPECT_TRUE(read_image(file, cv::IMREAD_UNCHANGED).empty());
}

}  // namespace
}  // namespace vinebench::harness
