// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/label_images.h"

#include <gmock/gmock.h>

#include "core/files/files.h"
#include "tests/support/broken_png.h"
#include "tests/support/label_folder.h"

namespace vinebench::harness {
namespace {

using test::LabelFolder;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(LabelImagesTest, EachIsReadAndCountedOnce) {
  LabelFolder folder;
  folder.put("depth", LabelFolder::filled(CV_16UC1, 7));
  EXPECT_THAT(folder.faults_of([](LabelImages& images) {
    EXPECT_EQ(images.read("depth", CV_16UC1).at<std::uint16_t>(2, 3), 7);
    EXPECT_EQ(images.read("depth", CV_16UC1).rows, 3);
    EXPECT_TRUE(images.read("semantic", CV_8UC1).empty());  // not recorded
    EXPECT_EQ(images.images(), 1);
  }),
              IsEmpty());
}

TEST(LabelImagesTest, AnotherSizeOrTypeIsOneFault) {
  LabelFolder folder;
  folder.put("depth", LabelFolder::filled(CV_8UC1, 7));
  const auto faults = folder.faults_of([](LabelImages& images) {
    EXPECT_TRUE(images.read("depth", CV_16UC1).empty());
    EXPECT_TRUE(images.read("depth", CV_16UC1).empty());
  });
  EXPECT_THAT(faults, ElementsAre("depth/left/000000.png: is not a complete image of 4 x 3 "
                                  "pixels of its type"));
}

TEST(LabelImagesTest, AHeaderOfGigapixelsIsAFault) {
  LabelFolder folder;
  folder.put("depth", LabelFolder::filled(CV_16UC1, 7));
  write_file_atomically(folder.sequence().folder / "depth/left/000000.png",
                        test::png_of_size(40000, 40000));
  const auto faults = folder.faults_of([](LabelImages& images) { images.read("depth", CV_16UC1); });
  EXPECT_THAT(faults, ElementsAre(testing::HasSubstr("found 40000 x 40000")));
}

TEST(LabelImagesTest, CountsWrongPixels) {
  const LabelFolder folder;
  const auto faults = folder.faults_of([](LabelImages& images) {
    // Of 3 rows of 4 pixels the first column is wrong: 3 pixels.
    images.expect_none("depth", {4, 3}, "is wrong", [](int, int x) { return x == 0; });
    images.expect_none("depth", {4, 3}, "is never wrong", [](int, int) { return false; });
  });
  EXPECT_THAT(faults, ElementsAre("depth/left/000000.png: is wrong at 3 pixels"));
}

}  // namespace
}  // namespace vinebench::harness
