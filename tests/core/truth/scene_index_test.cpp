// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/scene_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/util/error.h"

namespace vinebench {
namespace {

/// Two vines of one model with bunches 1 and 2, a post, and a rover.
SceneIndex small_index() {
  std::vector<SceneIndex::Place> places(3);
  places[0] = {{Thing::kVine, 0, 10, 0, "vine"}, 0, {}, 1};
  places[1] = {{Thing::kVine, 1, 11, 0, "vine"}, 0, {Eigen::Quaterniond::Identity(), {2, 0, 0}}, 3};
  places[2] = {{Thing::kPost, 2, 5, 0, "post"}, 1, {}, 1};
  SceneIndex::Points points;
  points[{0, 0}] = {{0, 0, 0}, {0, 0, 1}};
  points[{0, 1}] = {{1, 0, 0}};
  points[{0, 2}] = {{0, 1, 0}};
  points[{1, 0}] = {{0, 0, 2}};
  return {places, points, InstanceName{Thing::kRover, -1, -1, 0, "rover"}};
}

TEST(SceneIndexTest, NumbersNameThingsAndParts) {
  const SceneIndex index = small_index();
  EXPECT_EQ(index.name(512 + 2).id, 11);
  EXPECT_EQ(index.name(512 + 2).part, 2);
  EXPECT_EQ(index.thing(768), Thing::kPost);
  EXPECT_EQ(index.thing(1024), Thing::kRover);  // after the last instance
  EXPECT_EQ(index.thing(0), Thing::kNone);
  EXPECT_THROW(index.thing(1280), Error);
}

// The model's point (1, 0, 0), three times as large and 2 m along x: 2 + 3.
TEST(SceneIndexTest, PointsLieInTheWorld) {
  const auto points = small_index().points(512 + 1);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0], Eigen::Vector3d(5, 0, 0));
  EXPECT_EQ(small_index().points(256).size(), 2u);
  EXPECT_TRUE(small_index().points(0).empty());
  EXPECT_TRUE(small_index().points(1024).empty());     // the rover's are not known
  EXPECT_TRUE(small_index().points(256 + 9).empty());  // no such bunch
}

TEST(SceneIndexTest, BunchesAreThePartsOfVines) {
  EXPECT_THAT(small_index().bunches(), testing::ElementsAre(256 + 1, 256 + 2, 512 + 1, 512 + 2));
}

}  // namespace
}  // namespace vinebench
