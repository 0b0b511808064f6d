// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/scene_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/broken_files.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using test::small_plant;
using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class SceneCheckTest : public testing::Test {
 protected:
  SceneCheckTest() {
    scene_.instances.push_back({add_asset(scene_, small_plant()), Pose{}, 1, 0});
    scene_.wires.push_back({{0, 0, 0}, {1, 0, 0}, 0.001f, 0});
  }
  std::string problem() const {
    const std::string error = error_of([&] { check_scene(scene_); });
    EXPECT_THAT(error, HasSubstr("scene: "));
    return error;
  }
  Primitive& primitive() { return scene_.models[0].levels[0].primitives[0]; }
  Scene scene_;
};

TEST_F(SceneCheckTest, TheSceneItselfIsWhole) {
  EXPECT_NO_THROW(check_scene(scene_));
}

TEST_F(SceneCheckTest, TexturesOfWrongSizeOrKind) {
  cv::Mat& rgba = scene_.textures[0].rgba;
  for (const cv::Mat& wrong : {cv::Mat(), cv::Mat(0, 4, CV_8UC4), cv::Mat(4, 4, CV_8UC3),
                               cv::Mat(4, 4, CV_32FC4), cv::Mat(4, 4, CV_8UC1)}) {
    rgba = wrong;
    EXPECT_THAT(problem(), HasSubstr("texture 'leaf': expected an image of 4 channels"));
  }
  rgba = cv::Mat(1, 16385, CV_8UC4);
  EXPECT_THAT(problem(), HasSubstr("at most 16384 pixels a side, found 16385 x 1"));
  rgba = cv::Mat(3, 17, CV_8UC4);
  EXPECT_NO_THROW(check_scene(scene_));
}

TEST_F(SceneCheckTest, MotionsOfNothingOrToNowhere) {
  scene_.motions.push_back({1, [](Stamp) { return Pose{}; }});
  EXPECT_THAT(problem(), HasSubstr("motion 0 names instance 1"));
  scene_.motions[0] = {0, {}};
  EXPECT_THAT(problem(), HasSubstr("motion 0: expected a pose for each instant"));
}

TEST_F(SceneCheckTest, WhatNamesWhatIsNotThere) {
  primitive().indices[1] = 1u << 31;
  EXPECT_THAT(problem(), HasSubstr("model 'plant' names vertex 2147483648"));
  primitive().indices[1] = 0;
  primitive().material = 2;
  EXPECT_THAT(problem(), HasSubstr("model 'plant' names material 2, expected 0 to 1"));
  primitive().material = 0;
  primitive().indices.pop_back();
  EXPECT_THAT(problem(), HasSubstr("three for each triangle"));
  scene_.models[0].levels[0].primitives.clear();
  scene_.materials[1].texture = -2;
  EXPECT_THAT(problem(), HasSubstr("material 'bark' names texture -2"));
  scene_.materials[1].texture = -1;
  scene_.instances[0].model = -1;
  EXPECT_THAT(problem(), HasSubstr("instance 0 names model -1"));
  scene_.instances.clear();
  scene_.wires[0].material = 9;
  EXPECT_THAT(problem(), HasSubstr("wire 0 names material 9"));
  scene_.wires.clear();
  scene_.rover_model = 1;
  EXPECT_THAT(problem(), HasSubstr("the rover names model 1, expected 0 to 0"));
}

TEST_F(SceneCheckTest, ScalesArePositiveAndPlacesWithinReach) {
  for (const float scale : {0.0f, -1.0f, std::numeric_limits<float>::infinity()}) {
    scene_.instances[0].scale = scale;
    EXPECT_THAT(problem(), HasSubstr("instance 0: expected a scale above 0"));
  }
  scene_.instances[0].scale = 1;
  // A thousand kilometres, beyond which squares of distances overflow.
  scene_.instances[0].T_world_model.translation.x() = -2e6;
  EXPECT_THAT(problem(), HasSubstr("instance 0"));
  scene_.instances[0].T_world_model.translation.x() = -1e6;
  EXPECT_NO_THROW(check_scene(scene_));
  primitive().vertices[2].position.z() = 2e6f;
  EXPECT_THAT(problem(), HasSubstr("vertex 2"));
}

TEST_F(SceneCheckTest, NumbersThatAreNone) {
  const auto broken = [&](auto& number) {
    const auto sound = number;
    number = kNan;
    const std::string error = problem();
    number = sound;
    return error;
  };
  EXPECT_THAT(broken(primitive().vertices[1].position.x()), HasSubstr("model 'plant': vertex 1"));
  EXPECT_THAT(broken(primitive().vertices[1].normal.x()), HasSubstr("vertex 1"));
  EXPECT_THAT(broken(scene_.materials[0].colour.x()), HasSubstr("material 'leaf'"));
  EXPECT_THAT(broken(scene_.models[0].levels[0].until), HasSubstr("model 'plant'"));
  EXPECT_THAT(broken(scene_.instances[0].scale), HasSubstr("instance 0"));
  EXPECT_THAT(broken(scene_.instances[0].T_world_model.translation.z()), HasSubstr("instance 0"));
  EXPECT_THAT(broken(scene_.wires[0].to.y()), HasSubstr("wire 0"));
  EXPECT_THAT(broken(scene_.light.haze), HasSubstr("light"));
  EXPECT_THAT(broken(scene_.light.glare), HasSubstr("light"));
  EXPECT_THAT(broken(scene_.wind.speed), HasSubstr("wind"));
  EXPECT_NO_THROW(check_scene(scene_));
}

}  // namespace
}  // namespace vinebench::sim
