// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/tag_family.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/tag_reading.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;

TEST(TagFamilyTest, HasTheLayoutOfTheLibrarysDocumentation) {
  const TagFamily classic("tag36h11");
  EXPECT_EQ(classic.size(), 587);
  EXPECT_EQ(classic.modules(), 10);  // 6 of data, a ring of black, a ring of white
  EXPECT_EQ(classic.border_modules(), 8);
  EXPECT_FALSE(classic.reversed_border());
  const TagFamily standard("tagStandard41h12");
  EXPECT_EQ(standard.size(), 2115);
  EXPECT_EQ(standard.modules(), 9);
  EXPECT_EQ(standard.border_modules(), 5);
  EXPECT_TRUE(standard.reversed_border());
  EXPECT_EQ(TagFamily("tag16h5").size(), 30);
  EXPECT_EQ(TagFamily("tag25h9").size(), 35);
}

TEST(TagFamilyTest, EveryNameIsKnownAndLoads) {
  EXPECT_EQ(TagFamily::names().size(), 9u);
  for (const std::string& name : TagFamily::names()) {
    EXPECT_TRUE(TagFamily::known(name));
    EXPECT_GT(TagFamily(name).size(), 0) << name;
  }
  EXPECT_FALSE(TagFamily::known("tag37h11"));
  EXPECT_THAT(test::error_of([] { TagFamily("tag37h11"); }), HasSubstr("\"tag37h11\""));
}

TEST(TagFamilyTest, ThePrintHasAWhiteRimAroundABlackSquare) {
  const cv::Mat print = TagFamily("tag36h11").image(3);
  ASSERT_EQ(print.size(), cv::Size(10, 10));
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) {
      const int ring = std::min({x, y, 9 - x, 9 - y});
      const int cell = print.at<std::uint8_t>(y, x);
      EXPECT_TRUE(cell == 0 || cell == 255);
      EXPECT_TRUE(ring > 1 || cell == (ring == 0 ? 255 : 0)) << x << " " << y;
    }
  }
}

TEST(TagFamilyTest, ThePrintIsReadAsItsId) {
  for (const char* name : {"tag36h11", "tag25h9"}) {
    const TagFamily family(name);
    for (const int id : {0, family.size() - 1}) {
      cv::Mat large;
      cv::resize(family.image(id), large, {}, 16, 16, cv::INTER_NEAREST);
      cv::copyMakeBorder(large, large, 40, 40, 40, 40, cv::BORDER_CONSTANT, 255);
      const std::vector<test::ReadTag> tags = test::read_tags(large, family);
      ASSERT_EQ(tags.size(), 1u) << name << " " << id;
      EXPECT_EQ(tags[0].id, id);
      EXPECT_EQ(tags[0].wrong_bits, 0);
    }
  }
}

TEST(TagFamilyTest, AnIdBeyondItsTableIsAnError) {
  const TagFamily family("tag16h5");
  EXPECT_THAT(test::error_of([&] { family.image(30); }), HasSubstr("no tag 30"));
  EXPECT_THAT(test::error_of([&] { family.image(-1); }), HasSubstr("no tag -1"));
}

TEST(TagFamilyTest, ABoardHasARimAroundThePrint) {
  EXPECT_NEAR(tag_board_scale("tag36h11"), 12.0 / 8, 1e-12);
  EXPECT_NEAR(tag_board_scale("tagStandard41h12"), 11.0 / 5, 1e-12);
  EXPECT_NE(test::error_of([] { tag_board_scale("none"); }), "");
}

}  // namespace
}  // namespace vinebench::sim
