// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/labels/label_table.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

TEST(LabelTableTest, EachLabelHasAColourOfItsOwn) {
  // Black, of a number that is no label, is none of them: an entry that is missing would have it.
  std::set<int> colours;
  for (std::size_t i = 0; i <= kLabels; ++i) {
    const cv::Vec3b colour = label_colour(static_cast<std::uint8_t>(i));
    colours.insert((colour[0] << 16) + (colour[1] << 8) + colour[2]);
  }
  EXPECT_EQ(colours.size(), kLabels + 1);
  EXPECT_EQ(label_colour(kLabels), cv::Vec3b(0, 0, 0));
}

TEST(LabelTableTest, TheTextHasALineForEachLabel) {
  const std::string text = label_table_text();
  EXPECT_EQ(std::ranges::count(text, '\n'), static_cast<std::ptrdiff_t>(1 + kLabels));
  EXPECT_THAT(text, HasSubstr("labels:\n  - {id: 0, name: sky, colour: [135, 190, 235]}\n"));
  EXPECT_THAT(text, HasSubstr("  - {id: 16, name: occluder, colour: [110, 110, 160]}\n"));
}

TEST(LabelTableTest, EveryCategoryButThePlantHasLabels) {
  std::set<Category> categories;
  for (std::size_t i = 0; i < kLabels; ++i) categories.insert(category_of(static_cast<Label>(i)));
  EXPECT_EQ(categories.size(), kCategories - 1);
  EXPECT_FALSE(categories.contains(Category::kPlant));
}

TEST(LabelTableTest, EachCategoryHasANameOfItsOwn) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < kCategories; ++i) {
    names.insert(category_name(static_cast<Category>(i)));
  }
  EXPECT_EQ(names.size(), kCategories);
  EXPECT_STREQ(category_name(Category::kBunch), "bunch");
  EXPECT_STREQ(category_name(Category::kOccluder), "occluder");
}

TEST(LabelTableTest, OccludersCanBeCountedAndTheGroundCannot) {
  EXPECT_TRUE(is_thing(category_of(Label::kTarpaulin)));
  EXPECT_TRUE(is_thing(category_of(Label::kCrate)));
  EXPECT_FALSE(is_thing(category_of(Label::kGround)));
  EXPECT_FALSE(is_thing(category_of(Label::kWire)));
}

}  // namespace
}  // namespace vinebench::harness
