// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/placement/plan_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

TagCandidate candidate(int row, int index) {
  TagCandidate made;
  made.tag.id = 77;
  made.tag.post = sim::WorldConfig::PostSide{};
  made.tag.post->row = row;
  made.tag.post->index = index;
  made.tag.post->side = sim::WorldConfig::PostSide::Side::kLeft;
  // z into the tag, which faces north.
  made.placed.T_world_tag = {exp_so3({-1.5707963267948966, 0, 0}).inverse(),
                             {1.0 * index, 1.0 * row, 0.5}};
  return made;
}

TEST(PlanFilesTest, TagsAreNumberedAlongTheRows) {
  TagPlan plan;
  plan.chosen = {2, 0, 1};
  const auto tags = planned_tags({candidate(1, 4), candidate(1, 0), candidate(0, 3)}, plan);
  ASSERT_EQ(tags.size(), 3u);
  EXPECT_EQ(tags[0].tag.post->row, 0);
  EXPECT_EQ(tags[1].tag.post->index, 0);
  EXPECT_EQ(tags[2].tag.id, 2);
}

TEST(PlanFilesTest, TheWorldsTagsAreReplaced) {
  const std::string tags =
      "tags:\n  - {id: 77, size: 0.161, post: {row: 0, index: 3, side: left, height: 0.5}}\n";
  EXPECT_EQ(
      with_tags("rows: []\ntags:\n  - {id: 1}\n  - {id: 2}\n# light\nsun: {}\n", {candidate(0, 3)}),
      "rows: []\n" + tags + "# light\nsun: {}\n");
  EXPECT_EQ(with_tags("rows: []\n", {candidate(0, 3)}), "rows: []\n\n" + tags);
}

TEST(PlanFilesTest, TheListIsForPeople) {
  const std::string list = tag_list({candidate(0, 3)});
  EXPECT_THAT(list, HasSubstr("\n77,1,4,left,0.50,3.000,0.000,"));
}

TEST(PlanFilesTest, ThePictureHasEveryTag) {
  sim::WorldConfig world;
  world.rows = {{{0, 0}, {10, 0}}};
  TagPlan plan;
  plan.errors = {0, 0.01};
  plan.error = 0.01;
  const std::string svg = plan_svg(world, {Pose{}, Pose{{1, 0, 0, 0}, {5, 0, 0}}},
                                   {candidate(0, 3), candidate(0, 4)}, plan);
  EXPECT_THAT(svg, HasSubstr("2 tags; 95 % of the poses within 10 mm"));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
  std::size_t squares = 0;
  for (std::size_t at = svg.find("fill=\"black\""); at != std::string::npos;
       at = svg.find("fill=\"black\"", at + 1)) {
    ++squares;
  }
  EXPECT_EQ(squares, 2u);
}

}  // namespace
}  // namespace vinebench::harness
