// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// Repeatability of corners in images of the included worlds, near and far, without flicker by
// aliasing. The corners that the SLAM core's extractor selects in one image are searched among all
// of its candidates in the next: the test is about the images, not about the selection.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/geometry/rig.h"
#include "harness/benchmarks/render_benchmark.h"
#include "harness/machine.h"
#include "sim/config_files.h"
#include "sim/render/gl/gl_renderer.h"
#include "slam/features/orb_extractor.h"

namespace vinebench::harness {
namespace {

const std::filesystem::path kSource = VINEBENCH_SOURCE_DIR;
constexpr double kShift = 0.25;    // px
constexpr double kNear = 1.5;      // px; tolerance of a repeated corner
constexpr double kFar = 10;        // m
constexpr double kElsewhere = 31;  // px; a shift with chance matches only

struct Corners {
  std::vector<Eigen::Vector2d> pixels;
  cv::Mat depth;

  bool has(const Eigen::Vector2d& expected) const {
    return std::ranges::any_of(
        pixels, [&](const Eigen::Vector2d& pixel) { return (pixel - expected).norm() < kNear; });
  }
};

class SteadyCornersTest : public testing::TestWithParam<const char*> {
 protected:
  static Corners corners(const slam::OrbExtractor& orb, sim::GlRenderer& renderer,
                         const PinholeCamera& camera, const Pose& T_world_cam) {
    sim::RenderRequest request;
    request.depth = true;
    const RenderedImage image = renderer.render(camera, T_world_cam, request);
    cv::Mat grey;
    cv::cvtColor(image.rgb, grey, cv::COLOR_RGB2GRAY);
    Corners found;
    found.depth = image.depth;
    for (const slam::Keypoint& keypoint : orb.extract(grey).features.keypoints) {
      found.pixels.emplace_back(keypoint.x, keypoint.y);
    }
    return found;
  }

  slam::OrbExtractor selecting_{slam::OrbConfig{}};
  slam::OrbExtractor finding_{slam::OrbConfig{20000}};
};

TEST_P(SteadyCornersTest, RepeatUnderAShiftOfAQuarterPixelNearAndFar) {
  const sim::WorldConfig world = sim::load_world(kSource / "worlds" / GetParam());
  const Rig rig = load_rig(kSource / "models" / "csl-rover" / "rig.yaml");
  sim::GlRenderer renderer(sim::build_scene(world, 1, machine_of_environment().plant_cache), {});
  int all = 0, again = 0, by_chance = 0;
  std::array<int, 3> at_depth{};  // below 1 m, 1 to 2 m, 2 to 10 m
  for (const Pose& T_world_body : aisle_route(world, 4)) {
    const RigCamera& mounted = rig.cameras[0];
    const Pose T_world_cam = T_world_body * mounted.T_body_cam;
    // Moving the principal point moves the whole image, without parallax.
    PinholeCamera moved = mounted.model;
    moved.cx += kShift;
    moved.cy += kShift;
    const Corners before = corners(selecting_, renderer, mounted.model, T_world_cam);
    const Corners after = corners(finding_, renderer, moved, T_world_cam);
    for (const Eigen::Vector2d& pixel : before.pixels) {
      const float depth = before.depth.at<float>(static_cast<int>(std::lround(pixel.y())),
                                                 static_cast<int>(std::lround(pixel.x())));
      if (depth <= 0 || depth > kFar) continue;
      const Eigen::Vector2d expected = pixel + Eigen::Vector2d(kShift, kShift);
      ++all;
      again += after.has(expected);
      by_chance += after.has(expected + Eigen::Vector2d(kElsewhere, 0));
      ++at_depth[depth < 1 ? 0 : depth < 2 ? 1 : 2];
    }
  }
  RecordProperty("repeated_percent", 100 * again / std::max(1, all));
  EXPECT_GE(again, 0.8 * all) << again << " of " << all;
  EXPECT_LE(by_chance, 0.35 * all) << by_chance << " of " << all;
  for (std::size_t i = 0; i < at_depth.size(); ++i) {
    EXPECT_GE(at_depth[i], 0.08 * all) << "at depths of class " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, SteadyCornersTest,
                         testing::Values("csl-vineyard.yaml", "many-rows.yaml",
                                         "typical-vineyard.yaml"));

}  // namespace
}  // namespace vinebench::harness
