// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/platform/gl_context.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "core/geometry/rig.h"
#include "core/util/error.h"
#include "sim/render/gl/gl_renderer.h"
#include "sim/rover/rover_asset.h"
#include "sim/world/world.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

WorldConfig small_world() {
  WorldConfig world;
  world.rows = {{{0, -0.4}, {3, -0.4}}, {{0, 0.6}, {3, 0.6}}};
  world.vines.templates = 1;
  world.tags.push_back({});
  world.tags.back().position = {1.4, -0.3, 0.5};
  world.tags.back().facing_deg = 90;
  return world;
}

TEST(CurrentContextTest, KeepsOtherThreadsOutButWhileItWaits) {
  const std::unique_ptr<GlContext> context = make_gl_context();
  std::atomic<bool> was_in = false;
  std::thread other;
  {
    CurrentContext current(*context);
    bool entered = true;
    std::thread([&] { entered = gl_mutex().try_lock(); }).join();
    EXPECT_FALSE(entered);

    other = std::thread([&] {
      const std::scoped_lock lock(gl_mutex());
      was_in = true;
    });
    const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!was_in && std::chrono::steady_clock::now() < latest) current.wait();
    EXPECT_TRUE(was_in);
    current.gl().Clear(GL_COLOR_BUFFER_BIT);  // still current
    EXPECT_EQ(current.gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
  }
  other.join();
}

class GlBackendTest : public testing::Test {
 protected:
  RenderedImage image(GlBackend backend) const {
    RendererConfig config;
    config.backend = backend;
    config.shadow_map_size = 512;
    GlRenderer renderer(scene_, config);
    RenderRequest request;
    request.depth = true;
    request.instances = true;
    request.T_world_rover = Pose{from_roll_pitch_yaw({0, 0, 0.4}), {0.6, 0.1, 0}};
    return renderer.render(test::small_camera(), Rig::mount({-0.3, 0, 0.5}, {0, 0, 0}), request);
  }

  Scene world_with_rover() const {
    Scene scene = build_scene(small_world(), 1, cache_ / "plants");
    add_rover(scene, std::filesystem::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover/rover.xml");
    return scene;
  }

  test::TestFolder cache_;
  Scene scene_ = world_with_rover();
};

TEST_F(GlBackendTest, OsmesaAndEglGiveTheSameImage) {
  if (!has_osmesa() || !has_egl()) GTEST_SKIP() << "this build has one platform only";
  const RenderedImage osmesa = image(GlBackend::kOsmesa);
  const RenderedImage egl = image(GlBackend::kEgl);
  cv::Mat difference;
  cv::absdiff(osmesa.rgb, egl.rgb, difference);
  cv::Mat far_off;
  cv::inRange(difference, cv::Scalar(0, 0, 0), cv::Scalar(2, 2, 2), far_off);
  // A GPU may round differently from Mesa's software renderer: two grey levels in 99.9 % of the
  // pixels.
  EXPECT_GE(cv::countNonZero(far_off), 0.999 * static_cast<double>(far_off.total()));
  EXPECT_LE(cv::countNonZero(osmesa.instances != egl.instances),
            0.001 * static_cast<double>(far_off.total()));
  EXPECT_GT(cv::mean(osmesa.rgb)[1], 20);  // the image is not empty
}

TEST_F(GlBackendTest, BothMayLiveSideBySide) {
  if (!has_osmesa() || !has_egl()) GTEST_SKIP() << "this build has one platform only";
  RendererConfig config;
  config.shadow_map_size = 0;
  config.backend = GlBackend::kOsmesa;
  GlRenderer first(scene_, config);
  config.backend = GlBackend::kEgl;
  GlRenderer second(scene_, config);
  const Pose T_world_cam = Rig::mount({-0.3, 0, 0.5}, {0, 0, 0});
  const cv::Mat before = first.render(test::small_camera(), T_world_cam, {}).rgb;
  second.render(test::small_camera(), T_world_cam, {});
  const cv::Mat after = first.render(test::small_camera(), T_world_cam, {}).rgb;
  EXPECT_EQ(cv::norm(before, after, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace vinebench::sim
