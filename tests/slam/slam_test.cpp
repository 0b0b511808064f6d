// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/slam.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "tests/support/synthetic_texture.h"
#include "tests/support/test_folder.h"

namespace vinebench::slam {
namespace {

using test::render_image;
using test::SyntheticTexture;

// Two pairs look at two walls 1.5 m away (0.12 m of baseline at 200 px is 16 px) and move to their
// right, 15 mm a frame, which is 2 px.
constexpr int kWidth = 320;
constexpr int kHeight = 200;
constexpr int kDisparity = 16;
constexpr int kShift = 2;
constexpr double kStep = 0.015;  // m
constexpr int kFrames = 18;

Rig two_pairs() {
  RigConfig config;
  for (const char* name : {"front_left", "front_right", "back_left", "back_right"}) {
    RigConfig::Camera camera;
    camera.name = name;
    camera.width = kWidth;
    camera.height = kHeight;
    camera.fx = camera.fy = 200;
    if (std::string(name).find("right") != std::string::npos) camera.position.y() = -0.12;
    config.cameras.push_back(camera);
  }
  config.stereo_pairs = {{"front", "front_left", "front_right"},
                         {"back", "back_left", "back_right"}};
  return config.make();
}

const cv::Mat& wall(std::uint64_t texture) {
  const auto render = [](std::uint64_t seed) {
    return render_image(kWidth + kDisparity + kShift * kFrames, kHeight, SyntheticTexture(seed));
  };
  static const cv::Mat walls[] = {render(11), render(12)};
  return walls[texture];
}

/// The images `place` steps from the start.
Frame frame(int index, int place) {
  Frame seen;
  seen.index = index;
  seen.stamp = stamp_of_frame(index, 15);
  for (const std::uint64_t pair : {0U, 1U}) {
    for (const int shift : {0, kDisparity}) {
      seen.images.push_back(wall(pair)(cv::Rect(shift + kShift * place, 0, kWidth, kHeight)));
    }
  }
  return seen;
}

Eigen::Vector3d true_position(int place) {
  return {0, -kStep * place, 0};
}

/// One pixel of the coarser levels, 1.3 px, at 1.5 m and 200 px: for a flat wall a rotation is
/// similar to a lateral step.
constexpr double kPositionError = 0.01;  // m

std::unique_ptr<MappingSystem> system(WorkerPool& pool) {
  SlamConfig config;
  config.features.features = 400;
  return make_slam(config, two_pairs(), {}, pool);
}

class SlamTest : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  /// A map file of the path past the walls.
  std::filesystem::path saved_map() const {
    static const std::string bytes = drive_and_save();
    write_file_atomically(file("drive.map"), bytes);
    return file("drive.map");
  }

  WorkerPool pool_{2};

 private:
  test::TestFolder folder_;

  std::string drive_and_save() const {
    WorkerPool pool(2);
    const auto slam = system(pool);
    for (int i = 0; i < kFrames; ++i) slam->process(frame(i, i));
    slam->save_map(file("first.map"));
    return read_file(file("first.map"));
  }
};

TEST_F(SlamTest, ImagesToPoses) {
  const auto slam = system(pool_);
  for (int i = 0; i < kFrames; ++i) {
    const Estimate estimate = slam->process(frame(i, i));
    ASSERT_TRUE(estimate.T_map_body) << i;
    EXPECT_LT((estimate.T_map_body->translation - true_position(i)).norm(), kPositionError) << i;
  }
  EXPECT_EQ(slam->finish().trajectory.size(), static_cast<std::size_t>(kFrames));
}

TEST_F(SlamTest, AnyNumberOfThreadsGivesTheSameBits) {
  std::vector<std::string> maps;
  for (const int threads : {1, 3}) {
    WorkerPool pool(threads);
    const auto slam = system(pool);
    for (int i = 0; i < 6; ++i) slam->process(frame(i, 3 * i));
    slam->finish();
    slam->save_map(file("drive.map"));
    maps.push_back(read_file(file("drive.map")));
  }
  EXPECT_EQ(maps[0], maps[1]);
}

TEST_F(SlamTest, ALoadedMapIsFoundAgain) {
  const auto untouched = system(pool_);
  untouched->load_map(saved_map());
  const std::size_t landmarks = untouched->finish().landmarks;
  const auto slam = system(pool_);
  slam->load_map(saved_map());
  // From the middle of the path, in the opposite direction. Two frames must agree on the pose.
  EXPECT_EQ(slam->process(frame(0, 12)).status, TrackingStatus::kInitializing);
  for (int i = 1; i < 8; ++i) {
    const Estimate estimate = slam->process(frame(i, 12 - i));
    ASSERT_EQ(estimate.status, TrackingStatus::kTracking) << i;
    EXPECT_LT((estimate.T_map_body->translation - true_position(12 - i)).norm(), kPositionError);
    EXPECT_FALSE(estimate.keyframe) << i;  // the path is in the map
  }
  const SlamSummary summary = slam->finish();
  EXPECT_EQ(summary.trajectory.size(), 7u);
  EXPECT_TRUE(summary.keyframes.empty());
  EXPECT_EQ(summary.landmarks, landmarks);
}

TEST_F(SlamTest, ALoadedMapIsSavedAsItWas) {
  const auto slam = system(pool_);
  slam->load_map(saved_map());
  slam->save_map(file("again.map"));
  EXPECT_EQ(read_file(file("again.map")), read_file(saved_map()));
}

TEST_F(SlamTest, AMapIsLoadedBeforeTheFirstFrameOnly) {
  const auto slam = system(pool_);
  slam->process(frame(0, 0));
  EXPECT_THAT([&] { slam->load_map(saved_map()); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("before the first frame")));
}

TEST_F(SlamTest, TheCloudIsAPlyFile) {
  const auto slam = system(pool_);
  for (int i = 0; i < 4; ++i) slam->process(frame(i, 4 * i));
  slam->save_cloud(file("cloud.ply"));
  EXPECT_THAT(read_file(file("cloud.ply")),
              testing::StartsWith("ply\nformat binary_little_endian 1.0\n"));
}

}  // namespace
}  // namespace vinebench::slam
