// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/export_view.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/files/files.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_scene.h"

namespace vinebench::harness {
namespace {

TEST(LightFromAboveTest, IsTheMeanByTheCosineFromTheZenith) {
  cv::Mat panorama(180, 8, CV_32FC3, cv::Scalar::all(0.7));
  EXPECT_NEAR(light_from_above(panorama), 0.7, 1e-6);
  // Above 45 degrees of height lies half of a level surface's light (sin^2 45 = 0.5).
  panorama.rowRange(45, 180).setTo(cv::Scalar::all(0));
  EXPECT_NEAR(light_from_above(panorama), 0.35, 1e-3);
}

/// The glow of a sun at 30 degrees of height in the south-east, of the columns at longitude -45
/// degrees: 0.5 + 45 / 360 of the width, and 60 of 180 degrees below the zenith.
TEST(SkyPanoramaTest, TheSunIsWhereItStands) {
  sim::Light light;
  light.towards_sun = {0.6124f, -0.6124f, 0.5f};
  const cv::Mat panorama = sky_panorama(light, 1, {360, 180});
  const cv::Vec3f sun = panorama.at<cv::Vec3f>(60, 225);
  EXPECT_GT(sun[0], 1.2 * panorama.at<cv::Vec3f>(60, 135)[0]);
  EXPECT_GT(sun[0], 1.2 * panorama.at<cv::Vec3f>(60, 315)[0]);
  EXPECT_GT(sun[0], 1.2 * panorama.at<cv::Vec3f>(20, 225)[0]);
}

TEST(ExportViewTest, WritesSceneSkyAndCamera) {
  sim::Scene scene;
  const int material = test::add_material(scene, Label::kBox, Eigen::Vector3f::Ones());
  test::add_instance(scene, test::add_model(scene, test::panel(material, 0.8, 0.6)), {2, 3, 0});
  const test::TestFolder folder;
  sim::ExportedView view;
  view.camera = test::small_camera();
  view.T_world_cam = test::look_at({2, 0, 0.5}, {2, 3, 0});
  export_view(folder / "view", scene, view, 2.5, std::nullopt);

  const sim::Asset back = sim::load_asset(folder / "view" / "scene.glb");
  EXPECT_EQ(triangle_count(back.model.levels.at(0)), 2);
  const auto json = nlohmann::json::parse(read_file(folder / "view" / "camera.json"));
  EXPECT_EQ(json["width"], 752);
  EXPECT_EQ(json["exposure"], 2.5);
  EXPECT_NEAR(json["T_world_cam"][11].get<double>(), 0.5, 1e-12);  // z of the camera
  EXPECT_EQ(json["sun"]["towards"][2], 1);
  // The scaled sky lights level ground as the scene's ambient light does.
  const cv::Mat sky = cv::imread((folder / "view" / "sky.hdr").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(sky.type(), CV_32FC3);
  // Shared exponents of RGBE keep 8 bits.
  EXPECT_NEAR(json["sky"]["lighting"].get<double>() * light_from_above(sky), scene.light.sky.y(),
              0.01 * scene.light.sky.y());
}

}  // namespace
}  // namespace vinebench::harness
