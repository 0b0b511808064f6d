// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// Images of an included world against the camera model, with the SLAM core's tag detector.

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/geometry/rig.h"
#include "harness/machine.h"
#include "sim/config_files.h"
#include "sim/render/gl/gl_renderer.h"
#include "sim/world/world.h"
#include "sim/world/world_layout.h"
#include "slam/tags/tag_detector.h"

namespace vinebench::harness {
namespace {

const std::filesystem::path kRoot = VINEBENCH_SOURCE_DIR;

class WorldImageTest : public testing::Test {
 protected:
  sim::WorldConfig world_ = sim::load_world(kRoot / "worlds" / "csl-vineyard.yaml");
  Rig rig_ = load_rig(kRoot / "models" / "csl-rover" / "rig.yaml");
};

TEST_F(WorldImageTest, TheTagsCornersAreWhereTheSideCameraProjectsThem) {
  sim::GlRenderer renderer(sim::build_scene(world_, 1, machine_of_environment().plant_cache), {});
  const RigCamera& side = rig_.cameras[static_cast<std::size_t>(rig_.tag_cameras.at(0))];
  const WorldTag tag = sim::world_tags(world_).at(0);
  slam::TagDetector detector({}, sim::registered_tags(world_, 1));
  // The rover beside the tag; offset to either side and rotated, as when it passes.
  const double h = tag.size / 2;
  const std::array<Eigen::Vector3d, 4> corners{
      Eigen::Vector3d(-h, h, 0), {h, h, 0}, {h, -h, 0}, {-h, -h, 0}};
  for (const Eigen::Vector3d& at :
       {Eigen::Vector3d(0, 0, 0), {0.06, 0.1, 0.1}, {-0.05, 0.2, -0.2}, {0.1, 0.3, 0.15}}) {
    const Pose T_world_body{exp_so3({0, 0, at.z()}), {at.x(), at.y(), 0}};
    const Pose T_world_cam = T_world_body * side.T_body_cam;
    const RenderedImage image = renderer.render(side.model, T_world_cam, {});
    cv::Mat grey;
    cv::cvtColor(image.rgb, grey, cv::COLOR_RGB2GRAY);
    const std::vector<TagSighting> seen = detector.detect(grey, side.model, 4);
    ASSERT_EQ(seen.size(), 1u) << at.transpose();
    EXPECT_EQ(seen[0].id, 0);
    const Pose T_cam_tag = T_world_cam.inverse() * tag.T_world_tag;
    double squares = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const double error = (seen[0].corners[c] - side.model.project(T_cam_tag * corners[c])).norm();
      squares += error * error;
      // At 30 degrees the far edge uses a coarser mip level.
      EXPECT_LT(error, 0.15) << "corner " << c << " from " << at.transpose();
    }
    // The project's convention requires a tenth of a pixel.
    EXPECT_LT(std::sqrt(squares / 4), 0.1) << "from " << at.transpose();
    EXPECT_LT((seen[0].T_cam_tag.translation - T_cam_tag.translation).norm(), 0.0005);  // m
  }
}

}  // namespace
}  // namespace vinebench::harness
