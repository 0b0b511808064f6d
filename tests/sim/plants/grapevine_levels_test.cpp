// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <opencv2/core.hpp>

#include "sim/plants/grapevine.h"
#include "sim/plants/plant_textures.h"
#include "sim/render/gl/gl_renderer.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

/// The appearance of a plant: the share of the image that it covers, and its mean colour (RGB, 0 to
/// 255).
struct Look {
  double coverage = 0;
  cv::Scalar colour;
};

Scene scene_of(const Asset& plant, std::size_t level) {
  Scene scene;
  Asset one = plant;
  one.model.levels = {one.model.levels.at(level)};
  one.model.levels[0].until = 1e9;
  const int model = add_asset(scene, std::move(one));
  for (const double x : {-1.0, 0.0, 1.0}) test::add_instance(scene, model, {x, 0, 0});
  scene.light.towards_sun = Eigen::Vector3f(0.4f, -0.5f, 0.75f).normalized();
  return scene;
}

const std::array<Eigen::Vector3d, 4> kTowards{
    Eigen::Vector3d(0, -1, 0.1), Eigen::Vector3d(0, 1, 0.1), Eigen::Vector3d(1, -1, 0.2),
    Eigen::Vector3d(1, -0.2, 0.05)};

/// A metre of row from 8 m away in each direction, 240 pixels wide in the image.
std::vector<Look> looks_of_level(const Asset& plant, std::size_t level) {
  constexpr double kDistance = 8, kFocal = 240 * kDistance;
  const PinholeCamera camera{240, 360, kFocal, kFocal, 119.5, 179.5, {}};
  const Eigen::Vector3d middle(0, 0, 0.8);
  GlRenderer renderer(scene_of(plant, level), {});
  std::vector<Look> looks;
  for (const Eigen::Vector3d& towards : kTowards) {
    const Pose T_world_cam = test::look_at(middle + kDistance * towards.normalized(), middle);
    const RenderedImage image = renderer.render(camera, T_world_cam, {true, false});
    cv::Mat seen;  // the farthest levels merge parts
    cv::inRange(image.labels, static_cast<int>(Label::kCane), static_cast<int>(Label::kBunch),
                seen);
    looks.push_back(
        {cv::countNonZero(seen) / static_cast<double>(seen.total()), cv::mean(image.rgb, seen)});
  }
  return looks;
}

class LevelsTest : public testing::TestWithParam<int> {};

TEST_P(LevelsTest, AllHaveTheSameCoverageAndColour) {
  PlantBrief brief;
  brief.stage = growth_stage(GetParam());
  const auto textures = plant_textures({}, brief.stage, 1);
  const Asset plant = mesh_grapevines({grow_grapevine(brief, 1, 0)}, textures).at(0);
  const std::vector<Look> near = looks_of_level(plant, 0);
  for (std::size_t level = 1; level < 6; ++level) {
    const std::vector<Look> looks = looks_of_level(plant, level);
    for (std::size_t i = 0; i < looks.size(); ++i) {
      SCOPED_TRACE(testing::Message()
                   << "level " << level << " from " << kTowards.at(i).transpose());
      ASSERT_GT(near[i].coverage, 0.15);
      // Cards hide thin gaps between leaves in oblique views: a fifth at most.
      EXPECT_NEAR(looks[i].coverage / near[i].coverage, 1, level < 3 ? 0.04 : 0.2);
      // A tenth of a colour's value is 0.15 f-stops: not noticeable outdoors.
      for (int c = 0; c < 2; ++c) {
        EXPECT_NEAR(looks[i].colour[c] / near[i].colour[c], 1, 0.1) << "channel " << c;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Stages, LevelsTest, testing::Values(65, 89, 95));

}  // namespace
}  // namespace vinebench::sim
