// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// The truth images of a whole vineyard.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "core/geometry/rig.h"
#include "core/truth/truth_images.h"
#include "sim/config_files.h"
#include "sim/render/gl/gl_renderer.h"
#include "sim/scene/scene_naming.h"
#include "sim/world/terrain.h"
#include "sim/world/world_layout.h"
#include "tests/support/image_warp.h"
#include "tests/support/shared_plants.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

using namespace test;

bool is(const cv::Mat& labels, int y, int x, Label label) {
  return labels.at<std::uint8_t>(y, x) == static_cast<std::uint8_t>(label);
}

int different_values(const cv::Mat& a, const cv::Mat& b) {
  return cv::countNonZero(cv::Mat(a != b).reshape(1));
}

class TruthWorldTest : public testing::Test {
 protected:
  static WorldConfig csl_vineyard() {
    WorldConfig world =
        load_world(std::filesystem::path(VINEBENCH_SOURCE_DIR) / "worlds/csl-vineyard.yaml");
    world.vines.templates = 2;
    return world;
  }
  const Scene& grow(const WorldConfig& world) {
    return scene_ = build_scene(world, 1, test::shared_plants());
  }
  /// In the aisle, turned slightly to one row.
  static Pose in_aisle(double x = -0.3, double y = 0.02, double yaw = 0.15, double pitch = 0) {
    return Rig::mount({x, y, 0.45}, {0, pitch, yaw});
  }
  TruthView view(GlRenderer& renderer, const Pose& T_world_cam, double time = 0,
                 double other_time = 0) const {
    return {camera_, T_world_cam,
            renderer.render(camera_, T_world_cam, truth_request(time, other_time))};
  }
  Eigen::Vector3d point(const TruthView& v, int x, int y) const {
    const double depth = v.image.depth.at<float>(y, x);
    return v.T_world_cam * (depth * camera_.unproject({x, y}));
  }

  Scene scene_;
  PinholeCamera camera_ = small_camera();
};

TEST_F(TruthWorldTest, FlowWarpsOneImageOntoTheNext) {
  GlRenderer renderer(grow(csl_vineyard()), {});
  // A frame of a rover at 0.75 m/s and 15 Hz, in a curve of 0.3 rad/s.
  const TruthView a = view(renderer, in_aisle()), b = view(renderer, in_aisle(-0.25, 0.03, 0.17));
  const FlowTruth forth = optical_flow(a, b), back = optical_flow(b, a);
  // 15 % leave the image; others are hidden by what is nearer or change their level of detail.
  EXPECT_GT(cv::countNonZero(forth.visible), 0.6 * forth.visible.total());

  const cv::Mat grey_a = grey_of(a.image.rgb), grey_b = grey_of(b.image.rgb);
  const double exact = mean_difference(grey_a, warped(grey_b, forth.flow), forth.visible);
  EXPECT_LT(exact, 0.5 * mean_difference(grey_a, grey_b, forth.visible));
  for (const cv::Vec2f& off : {cv::Vec2f(0.5f, 0), {-0.5f, 0}, {0, 0.5f}, {0, -0.5f}}) {
    EXPECT_GT(mean_difference(grey_a, warped(grey_b, forth.flow, off), forth.visible), exact);
  }
  const std::vector<double> shifts =
      patch_shifts(grey_a, warped(grey_b, forth.flow), forth.visible, forth.visible);
  EXPECT_GT(shifts.size(), 50u);
  EXPECT_LT(quantile(shifts, 0.5), 0.1);
  EXPECT_LT(quantile(shifts, 0.95), 0.5);

  const std::vector<double> trips = round_trips(forth, back, forth.visible);
  EXPECT_LT(quantile(trips, 0.5), 0.05);
  EXPECT_LT(quantile(trips, 0.99), 0.5);
  // Points visible in both images belong to the same instance.
  int same = 0, all = 0;
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      if (forth.visible.at<std::uint8_t>(y, x) == 0) continue;
      const cv::Vec2f f = forth.flow.at<cv::Vec2f>(y, x);
      const int u = std::min(cvRound(x + f[0]), camera_.width - 1);
      const int v = std::min(cvRound(y + f[1]), camera_.height - 1);
      ++all;
      same += a.image.labels.at<std::uint8_t>(y, x) == b.image.labels.at<std::uint8_t>(v, u);
    }
  }
  EXPECT_GT(same, 0.97 * all);
}

TEST_F(TruthWorldTest, DisparityWarpsTheRightImageOntoTheLeft) {
  constexpr double kStereoBaseline = 0.12;  // m
  GlRenderer renderer(grow(csl_vineyard()), {});
  const Pose left_camera = in_aisle();
  const Pose right_camera =
      left_camera * Pose{Eigen::Quaterniond::Identity(), {kStereoBaseline, 0, 0}};
  const TruthView left = view(renderer, left_camera), right = view(renderer, right_camera);
  const DisparityTruth truth = disparity(left, right);
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      const float depth = left.image.depth.at<float>(y, x);
      const double expected = depth == 0 ? 0 : camera_.fx * kStereoBaseline / depth;
      ASSERT_NEAR(truth.disparity.at<float>(y, x), expected, 0.01);
    }
  }
  const cv::Mat grey_left = grey_of(left.image.rgb), grey_right = grey_of(right.image.rgb);
  cv::Mat flow;
  const cv::Mat level = cv::Mat::zeros(truth.disparity.size(), CV_32F);
  cv::merge(std::vector<cv::Mat>{-truth.disparity, level}, flow);
  const std::vector<double> shifts =
      patch_shifts(grey_left, warped(grey_right, flow), truth.visible, truth.visible);
  EXPECT_GT(shifts.size(), 50u);
  EXPECT_LT(quantile(shifts, 0.5), 0.1);
  EXPECT_LT(quantile(shifts, 0.95), 0.5);
}

/// The labels allowed for an object.
bool may_show(Thing thing, Label label) {
  switch (thing) {
    case Thing::kGround:
    case Thing::kCover:
      return label == Label::kGround || label == Label::kGrass;
    case Thing::kVine:
      return label == Label::kTrunk || label == Label::kCane || label == Label::kLeaf ||
             label == Label::kBunch;
    case Thing::kPost:
      return label == Label::kPost;
    case Thing::kTag:
      return label == Label::kTag;
    case Thing::kBox:
      return label == Label::kBox || label == Label::kCrate;
    case Thing::kPerson:
      return label == Label::kPerson;
    case Thing::kRover:
      return label == Label::kRover;
    case Thing::kOccluder:
      return label == Label::kTarpaulin || label == Label::kLooseLeaf || label == Label::kOccluder;
    case Thing::kNone:
      return label == Label::kSky || label == Label::kWire;
  }
  return false;
}

TEST_F(TruthWorldTest, LabelsInstancesDepthAndNormalsAgreeWithTheGeometry) {
  WorldConfig world = csl_vineyard();
  world.occluders.push_back({.name = "box of tools", .position = {1.2, 0}});
  world.occluders.push_back({.shape = Occluder::Shape::kPerson, .position = {2.5, 0.05}});
  GlRenderer renderer(grow(world), {});
  std::map<Thing, int> seen;
  int bunches = 0, ground = 0, upright = 0;
  for (const Pose& pose : {in_aisle(), in_aisle(0.3, 0.1, -1.2), in_aisle(4.6, 0.8, 3.0, 0.2)}) {
    const TruthView v = view(renderer, pose);
    ASSERT_TRUE(v.image.motion.empty());  // there is no wind
    const Eigen::Matrix3d R_world_cam = pose.rotation.toRotationMatrix();
    for (int y = 0; y < camera_.height; ++y) {
      for (int x = 0; x < camera_.width; ++x) {
        const auto label = static_cast<Label>(v.image.labels.at<std::uint8_t>(y, x));
        const bool sky = label == Label::kSky;
        const cv::Vec3f n = v.image.normals.at<cv::Vec3f>(y, x);
        ASSERT_EQ(sky, v.image.depth.at<float>(y, x) == 0) << x << ", " << y;
        const InstanceName name = instance_name(scene_, v.image.instances.at<std::int32_t>(y, x));
        ASSERT_TRUE(may_show(name.thing, label)) << name_of(name.thing) << " " << int(label);
        ASSERT_EQ(name.part > 0, label == Label::kBunch) << x << ", " << y;
        ++seen[name.thing];
        bunches += label == Label::kBunch;
        if (sky) {
          ASSERT_EQ(n, cv::Vec3f(0, 0, 0));
          continue;
        }
        const Eigen::Vector3d normal(n[0], n[1], n[2]);
        // Sixteen bits over -1 to 1: each component is off by up to half a step, 1 / 65535, the
        // length by up to the square root of 3 times that.
        ASSERT_NEAR(normal.norm(), 1, 2.7e-5);
        ASSERT_LT(normal.dot(camera_.unproject({x, y})), 0) << x << ", " << y;
        const Eigen::Vector3d p = point(v, x, y);
        if (name.index >= 0) {
          const Instance& instance = scene_.instances[static_cast<std::size_t>(name.index)];
          const Model& model = scene_.models[static_cast<std::size_t>(instance.model)];
          const Eigen::Vector3f p_model =
              ((instance.T_world_model.inverse() * p) / instance.scale).cast<float>();
          // Cards of the far levels extend slightly beyond the finest level.
          ASSERT_LT(model.bounds.exteriorDistance(p_model), 0.03) << name.model << " " << p;
        }
        if (name.thing == Thing::kGround && v.image.depth.at<float>(y, x) < 15) {
          ASSERT_NEAR(p.z(), 0, 0.002) << x << ", " << y;
          ++ground;
          upright += (R_world_cam * normal).z() > 0.999;
        }
        if (name.thing == Thing::kTag && name.id == 0) {
          const Eigen::Vector3d face =
              tag_pose(lay_out(world).tags[0]).rotation * -Eigen::Vector3d::UnitZ();
          if (std::abs((tag_pose(lay_out(world).tags[0]).inverse() * p).z()) < 1e-4) {
            ASSERT_GT((R_world_cam * normal).dot(face), 0.999);
          }
        }
      }
    }
  }
  for (const Thing thing : {Thing::kNone, Thing::kGround, Thing::kVine, Thing::kPost, Thing::kTag,
                            Thing::kBox, Thing::kPerson, Thing::kCover}) {
    EXPECT_GT(seen[thing], 50) << name_of(thing);
  }
  EXPECT_GT(bunches, 1000);
  // Where tiles meet, a pixel may show the upper edge of the skirt below.
  EXPECT_GT(upright, 0.999 * ground);
}

TEST_F(TruthWorldTest, UnevenGroundIsWhereTheTerrainSays) {
  WorldConfig world = csl_vineyard();
  world.terrain.amplitude = 0.05;
  world.terrain.wavelength = 2;
  world.terrain.slope_percent = 3;
  // The finest level of the ground reaches 4 m for 750 px, so 4.2 m here; coarser ones cut bumps.
  GlRenderer renderer(grow(world), {.lod_scale = 3});
  const Terrain terrain = lay_out(world).terrain;
  int compared = 0;
  const TruthView v = view(renderer, in_aisle(-0.3, 0, 0.1, 0.3));
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      const InstanceName name = instance_name(scene_, v.image.instances.at<std::int32_t>(y, x));
      const Eigen::Vector3d p = point(v, x, y);
      if (name.thing != Thing::kGround || (p - v.T_world_cam.translation).norm() > 4) continue;
      if (!terrain.box().contains(terrain.frame().from_world(p.head<2>()))) continue;
      ASSERT_NEAR(p.z(), terrain.height(p.head<2>()), 0.002) << p.transpose();
      ++compared;
    }
  }
  EXPECT_GT(compared, 50000);
}

TEST_F(TruthWorldTest, AskingForTheTruthChangesNoByteOfTheImage) {
  grow(csl_vineyard());
  for (const bool windy : {false, true}) {
    Scene scene = scene_;
    if (windy) {
      scene.wind.speed = 4;
      scene.light.haze = 0.05f;
    }
    GlRenderer renderer(scene, {});
    const RenderedImage plain = renderer.render(camera_, in_aisle(), {.labels = true, .time = 2});
    const RenderedImage full = renderer.render(camera_, in_aisle(), truth_request(2, 2.1));
    EXPECT_EQ(different_values(plain.rgb, full.rgb), 0);
    EXPECT_EQ(different_values(plain.labels, full.labels), 0);
    const RenderedImage again = renderer.render(camera_, in_aisle(), {.labels = true, .time = 2});
    EXPECT_EQ(different_values(plain.rgb, again.rgb), 0);
  }
}

TEST_F(TruthWorldTest, WindMovesLeavesAndMotionSaysWhereTo) {
  constexpr double kTime = 3, kLater = 3.1;  // s
  Scene still = grow(csl_vineyard()), windy = still;
  windy.wind.speed = 4;
  // Without shadows, in which moving leaves would change their brightness.
  const RendererConfig config{.shadow_map_size = 0};
  GlRenderer calm(still, config), renderer(windy, config);
  const Pose pose = in_aisle(0.3, 0, 0.6, -0.25);
  EXPECT_EQ(different_values(calm.render(camera_, pose, {.time = kTime}).rgb,
                             calm.render(camera_, pose, {}).rgb),
            0);
  const TruthView a = view(renderer, pose, kTime, kLater), b = view(renderer, pose, kLater, kTime);
  EXPECT_GT(different_values(a.image.rgb, b.image.rgb), 50000);
  const FlowTruth forth = optical_flow(a, b), back = optical_flow(b, a);
  cv::Mat leaves = a.image.labels == static_cast<int>(Label::kLeaf);
  std::vector<double> lengths;
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      const double length = cv::norm(forth.flow.at<cv::Vec2f>(y, x));
      if (leaves.at<std::uint8_t>(y, x) != 0) lengths.push_back(length);
      if (is(a.image.labels, y, x, Label::kPost)) {
        ASSERT_LT(length, 0.001);
      }
      if (is(a.image.labels, y, x, Label::kTrunk)) {
        ASSERT_LT(length, 0.001);
      }
    }
  }
  EXPECT_GT(quantile(lengths, 0.5), 1);  // px: otherwise the test says nothing
  leaves &= forth.visible;
  EXPECT_GT(cv::countNonZero(leaves), 0.6 * static_cast<double>(lengths.size()));
  const std::vector<double> trips = round_trips(forth, back, leaves);
  EXPECT_LT(quantile(trips, 0.5), 0.1);
  EXPECT_LT(quantile(trips, 0.95), 0.5);
  const cv::Mat grey_a = grey_of(a.image.rgb), grey_b = grey_of(b.image.rgb);
  const std::vector<double> shifts =
      patch_shifts(grey_a, warped(grey_b, forth.flow), forth.visible, leaves);
  EXPECT_GT(shifts.size(), 20u);
  // Fewer and smaller patches than in still air: single ones are measured to half a pixel only.
  EXPECT_LT(quantile(shifts, 0.5), 0.2);
  EXPECT_LT(quantile(shifts, 0.9), 0.5);
}

}  // namespace
}  // namespace vinebench::sim
