// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/bag_cameras.h"

#include <gmock/gmock.h>

#include "harness/datasets/ros2/cdr/ros2_messages.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

/// A bag with these topics of images, of mono8 or compressed by their names.
BagContents bag_of(const std::vector<std::string>& topics) {
  BagContents contents;
  contents.names = {"run.mcap"};
  for (const std::string& topic : topics) {
    const bool compressed = topic.ends_with("/compressed");
    contents.topics[topic] = compressed ? ros2::kCompressedImage : ros2::kImage;
    contents.images[topic] = {contents.topics[topic], "", compressed ? "jpeg" : "mono8", {}};
  }
  return contents;
}

std::vector<std::string> topics_of(const BagCameras& chosen) {
  std::vector<std::string> topics;
  for (const BagCamera& camera : chosen.cameras) topics.push_back(camera.topic);
  return topics;
}

std::vector<std::string> names_of(const BagCameras& chosen) {
  std::vector<std::string> names;
  for (const BagCamera& camera : chosen.cameras) names.push_back(camera.name);
  return names;
}

TEST(BagCamerasTest, PairsComeBeforeOtherCamerasAndAreNamedByWhatTheyShare) {
  const BagCameras chosen = choose_bag_cameras(
      bag_of({"/back_left/image_rect", "/back_right/image_rect", "/front_left/image_rect",
              "/front_right/image_rect", "/a_side/image_raw"}),
      {});
  EXPECT_THAT(names_of(chosen),
              ElementsAre("back_left", "back_right", "front_left", "front_right", "a_side"));
  ASSERT_EQ(chosen.pairs.size(), 2u);
  EXPECT_EQ(chosen.pairs[0].name, "back");
  EXPECT_EQ(chosen.pairs[1].name, "front");
  EXPECT_EQ(chosen.pairs[1].left, 2);
  EXPECT_EQ(chosen.pairs[1].right, 3);
  EXPECT_EQ(chosen.cameras[4].info, "/a_side/camera_info");
  EXPECT_TRUE(chosen.cameras[0].rectified);
  EXPECT_FALSE(chosen.cameras[4].rectified);
}

TEST(BagCamerasTest, NamesOfOtherDriversArePairsToo) {
  EXPECT_THAT(topics_of(choose_bag_cameras(bag_of({"/cam0/image_raw", "/cam1/image_raw"}), {})),
              ElementsAre("/cam0/image_raw", "/cam1/image_raw"));
  EXPECT_THAT(names_of(choose_bag_cameras(
                  bag_of({"/camera/infra1/image_rect_raw", "/camera/infra2/image_rect_raw"}), {})),
              ElementsAre("infra1", "infra2"));
}

TEST(BagCamerasTest, EveryPairHasANameOfItsOwn) {
  std::vector<std::string> names;
  const BagContents contents =
      bag_of({"/a/cam0/image", "/a/cam1/image", "/back_left/image", "/back_right/image",
              "/c/back_left/image", "/c/back_right/image", "/d/cam0/image", "/d/cam1/image"});
  for (const StereoPair& pair : choose_bag_cameras(contents, {}).pairs) names.push_back(pair.name);
  EXPECT_THAT(names, ElementsAre("front", "back", "/c/back_left/image", "/d/cam0/image"));
}

TEST(BagCamerasTest, ARigHasAtMost64Cameras) {
  std::vector<std::string> topics;
  for (int i = 0; i < 65; ++i) topics.push_back(fmt::format("/c{}/image", i));
  EXPECT_THAT(error_of([&] { choose_bag_cameras(bag_of(topics), {}); }),
              HasSubstr("expected at most 64 cameras, found 65: --topics chooses some"));
}

TEST(BagCamerasTest, RectifiedBeforeRawAndRawBeforeCompressed) {
  BagContents contents =
      bag_of({"/left/image_raw", "/left/image_rect/compressed", "/right/image_rect",
              "/right/image_rect/compressed", "/left/something"});
  EXPECT_THAT(topics_of(choose_bag_cameras(contents, {})),
              ElementsAre("/left/image_rect/compressed", "/right/image_rect"));
  // Depth is no picture, by its encoding.
  contents.images["/right/image_rect"].coding = "16UC1";
  EXPECT_THAT(topics_of(choose_bag_cameras(contents, {})),
              ElementsAre("/left/image_rect/compressed", "/right/image_rect/compressed"));
}

TEST(BagCamerasTest, TopicsThatAreNamedAreTakenInTheirOrder) {
  const BagContents contents = bag_of({"/x/image", "/y/image", "/z/image", "/left/image_rect"});
  const BagCameras chosen = choose_bag_cameras(contents, {"/z/image", "/x/image", "/y/image"});
  EXPECT_THAT(topics_of(chosen), ElementsAre("/z/image", "/x/image", "/y/image"));
  ASSERT_EQ(chosen.pairs.size(), 1u);
  EXPECT_EQ(chosen.pairs[0].left, 0);
  EXPECT_THAT(error_of([&] {
                choose_bag_cameras(contents, {"/x/image", "/w/image"});
              }),
              HasSubstr("found '/w/image' among /left/image_rect (sensor_msgs/msg/Image), /x"));
  EXPECT_THAT(error_of([&] {
                choose_bag_cameras(contents, {"/x/image", "/x/image"});
              }),
              HasSubstr("is named twice"));
}

TEST(BagCamerasTest, WithoutImagesItIsAnErrorThatListsTheTopics) {
  BagContents contents = bag_of({});
  EXPECT_THAT(error_of([&] { choose_bag_cameras(contents, {}); }), HasSubstr("found no messages"));
  contents.topics["/scan"] = "sensor_msgs/msg/LaserScan";
  EXPECT_THAT(error_of([&] { choose_bag_cameras(contents, {}); }),
              HasSubstr("run.mcap: expected a stereo pair"));
  EXPECT_THAT(error_of([&] { choose_bag_cameras(contents, {}); }),
              HasSubstr("found /scan (sensor_msgs/msg/LaserScan)"));
  // Cameras without a pair may belong to a rig file.
  EXPECT_TRUE(choose_bag_cameras(bag_of({"/a/image"}), {}).pairs.empty());
}

TEST(BagCamerasTest, CamerasOfOneNameGetTheirTopics) {
  EXPECT_THAT(names_of(choose_bag_cameras(bag_of({"/a/left/image", "/b/left/image"}), {})),
              ElementsAre("/a/left/image", "/b/left/image"));
}

TEST(BagCamerasTest, ARigFileOrdersCamerasByTheirNames) {
  BagCameras chosen =
      choose_bag_cameras(bag_of({"/left/image", "/right/image", "/side/image"}), {});
  Rig rig;
  rig.cameras.resize(2);
  rig.cameras[0].name = "side";
  rig.cameras[1].name = "left";
  order_by_rig(rig, chosen.cameras);
  EXPECT_THAT(names_of(chosen), ElementsAre("side", "left"));
  rig.cameras[0].name = "other";
  order_by_rig(rig, chosen.cameras);
  EXPECT_THAT(names_of(chosen), ElementsAre("side", "left"));
}

}  // namespace
}  // namespace vinebench::harness
