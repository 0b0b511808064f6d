// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/front_end.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/util/error.h"
#include "tests/support/dirty_lens.h"
#include "tests/support/synthetic_plane.h"
#include "tests/support/synthetic_tag.h"

namespace vinebench::slam {
namespace {

using test::SyntheticPlane;
using test::SyntheticTag;

/// The rover's rig with small images.
Rig small_rig() {
  RigConfig config;
  for (const char* name : {"front_left", "front_right", "back_left", "back_right", "side"}) {
    RigConfig::Camera camera;
    camera.name = name;
    camera.width = 320;
    camera.height = 200;
    camera.fx = camera.fy = 200;
    if (std::string(name).find("right") != std::string::npos) camera.position.y() = -0.12;
    config.cameras.push_back(camera);
  }
  config.stereo_pairs = {{"front", "front_left", "front_right"},
                         {"back", "back_left", "back_right"}};
  config.tag_cameras = {"side"};
  return config.make();
}

class FrontEndTest : public testing::Test {
 protected:
  FrontEndTest() : rig_(make_stereo_rig(small_rig(), {})) {
    config_.features.features = 300;
    frame_.index = 4;
    frame_.stamp = stamp_of_frame(4, 15);
    static const std::vector<cv::Mat> images = render(rig_);
    frame_.images = images;
  }

  /// A textured wall 1.5 m in front of each pair and a tag in front of the side camera.
  static std::vector<cv::Mat> render(const StereoRig& rig) {
    std::vector<cv::Mat> images;
    for (const std::uint64_t texture : {11U, 12U}) {
      const SyntheticPlane plane{16, 0, 0, 320, 200, texture};
      images.push_back(plane.left(1));
      images.push_back(plane.right(1));
    }
    const Pose T_cam_tag{exp_so3({0.2, 0.1, 0}), {0, 0, 0.4}};
    images.push_back(SyntheticTag(6, 0.161).render(rig.cameras[4].model, T_cam_tag));
    return images;
  }

  std::shared_ptr<const FrameFeatures> process(const Frame& frame, int threads = 1) {
    WorkerPool pool(threads);
    FrontEnd front_end(config_, rig_, {}, pool);
    return front_end.process(frame, times_);
  }

  void expect_error(const std::string& camera, const std::string& what) {
    EXPECT_THAT([&] { process(frame_); },
                testing::ThrowsMessage<Error>(testing::AllOf(testing::HasSubstr("frame 4"),
                                                             testing::HasSubstr("'" + camera + "'"),
                                                             testing::HasSubstr(what))));
  }

  StereoRig rig_;
  FrontEndSettings config_;
  Frame frame_;
  StageTimes times_;
};

/// Features that are found where the wall is: 200 px * 0.12 m / 16 px = 1.5 m.
std::ptrdiff_t on_the_wall(const StereoView& view) {
  return std::ranges::count_if(
      view.stereo, [](const StereoMatch& m) { return std::abs(m.depth - 1.5F) < 0.03F; });
}

TEST_F(FrontEndTest, ViewsAndTagsKnowHowLateTheirImagesAre) {
  frame_.image_stamps.assign(5, frame_.stamp);
  frame_.image_stamps[2] += 5'000'000;   // the back pair's left eye
  frame_.image_stamps[4] -= 20'000'000;  // the side camera
  const auto features = process(frame_);
  EXPECT_EQ(features->views[0].late, 0);
  EXPECT_DOUBLE_EQ(features->views[1].late, 0.005);
  ASSERT_EQ(features->tags.size(), 1u);
  EXPECT_DOUBLE_EQ(features->tags[0].late, -0.02);
  frame_.image_stamps.pop_back();
  EXPECT_THAT([&] { process(frame_); }, testing::ThrowsMessage<Error>(testing::HasSubstr(
                                            "frame 4: expected 5 stamps of images, found 4")));
}

/// All results, byte by byte.
std::string bytes_of(const FrameFeatures& features) {
  std::string bytes;
  const auto append = [&](const auto& values) {
    for (const auto& value : values) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  };
  for (const StereoView& view : features.views) {
    append(view.features.keypoints);
    append(view.features.descriptors);
    append(view.stereo);
  }
  for (const TagSighting& tag : features.tags) {
    for (const Eigen::Vector2d& corner : tag.corners) append(std::array{corner.x(), corner.y()});
    append(std::array{tag.T_cam_tag.translation.x(), tag.T_cam_tag.rotation.x()});
  }
  return bytes;
}

TEST_F(FrontEndTest, GivesEachPairItsFeaturesAndEachTagItsSighting) {
  const auto features = process(frame_);
  EXPECT_EQ(features->index, 4);
  EXPECT_EQ(features->stamp, frame_.stamp);
  ASSERT_EQ(features->views.size(), 2u);
  for (const StereoView& view : features->views) {
    ASSERT_GT(view.features.size(), 200u);
    ASSERT_EQ(view.stereo.size(), view.features.size());
    EXPECT_GT(on_the_wall(view), 150);
    std::vector<int> near;
    view.grid.query(160, 100, 400, 0, 7, near);
    EXPECT_EQ(near.size(), view.features.size());
  }
  ASSERT_EQ(features->tags.size(), 1u);
  EXPECT_EQ(features->tags[0].id, 6);
  EXPECT_EQ(features->tags[0].camera, 4);
}

TEST_F(FrontEndTest, MatchesAPairWhoseEyesDifferInBrightness) {
  const auto alike = process(frame_);
  for (const auto& [camera, gain] : {std::pair{0U, 0.62}, std::pair{3U, 0.5}}) {
    cv::Mat dimmed;
    frame_.images[camera].convertTo(dimmed, -1, gain);
    frame_.images[camera] = dimmed;
  }
  const auto unlike = process(frame_);
  for (std::size_t v = 0; v < 2; ++v) {
    // What is dimmer by half has half the corners' contrast, and some fall below a threshold.
    EXPECT_GT(on_the_wall(unlike->views[v]), on_the_wall(alike->views[v]) * 8 / 10);
  }
}

TEST_F(FrontEndTest, MatchesAPairWhoseEyesAreOnOtherRows) {
  const auto straight = process(frame_);
  for (const auto& [camera, rows] : {std::pair{1U, 2}, std::pair{3U, -3}}) {
    cv::Mat& image = frame_.images[camera];
    cv::Mat lower;
    const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, 0, 0, 1, rows);
    cv::warpAffine(image, lower, shift, image.size(), cv::INTER_NEAREST, cv::BORDER_REPLICATE);
    image = lower;
  }
  const auto crooked = process(frame_);
  for (std::size_t v = 0; v < 2; ++v) {
    EXPECT_GT(on_the_wall(crooked->views[v]), on_the_wall(straight->views[v]) * 9 / 10);
  }
}

TEST_F(FrontEndTest, MatchesAPairWithADirtyEye) {
  const auto clean = process(frame_);
  frame_.images[1] = test::through_dirt(frame_.images[1]);
  const auto features = process(frame_);
  EXPECT_GT(on_the_wall(features->views[0]), on_the_wall(clean->views[0]) / 2);
}

TEST_F(FrontEndTest, ThreadsChangeNoByte) {
  const std::string alone = bytes_of(*process(frame_, 1));
  EXPECT_GT(alone.size(), 20000u);
  EXPECT_EQ(bytes_of(*process(frame_, 2)), alone);
  EXPECT_EQ(bytes_of(*process(frame_, 4)), alone);
}

TEST_F(FrontEndTest, OneFrameLeavesNothingForTheNext) {
  WorkerPool pool(1);
  FrontEnd front_end(config_, rig_, {}, pool);
  const std::string first = bytes_of(*front_end.process(frame_, times_));
  Frame blind = frame_;
  for (cv::Mat& image : blind.images) image = cv::Mat();
  const auto nothing = front_end.process(blind, times_);
  EXPECT_TRUE(bytes_of(*nothing).empty());
  EXPECT_EQ(bytes_of(*front_end.process(frame_, times_)), first);
}

TEST_F(FrontEndTest, AnEmptyImageHasNoFeatures) {
  frame_.images[0] = cv::Mat();  // front left: the front pair has no features
  frame_.images[3] = cv::Mat();  // back right: features without a match
  frame_.images[4] = cv::Mat();
  const auto features = process(frame_);
  EXPECT_EQ(features->views[0].features.size(), 0u);
  EXPECT_GT(features->views[1].features.size(), 200u);
  for (const StereoMatch& match : features->views[1].stereo) {
    EXPECT_EQ(match.depth, -1);
    EXPECT_EQ(match.x_right, -1);
  }
  EXPECT_TRUE(features->tags.empty());
}

TEST_F(FrontEndTest, ColourImagesAreRead) {
  const std::string grey = bytes_of(*process(frame_));
  for (cv::Mat& image : frame_.images) {
    const cv::Mat channels[] = {image, image, image};
    cv::Mat colour;
    cv::merge(channels, 3, colour);
    image = colour;
  }
  EXPECT_EQ(bytes_of(*process(frame_)), grey);  // three equal channels give the same grey
}

TEST_F(FrontEndTest, AWrongSizeIsAnErrorThatNamesTheCamera) {
  frame_.images[3] = frame_.images[3].colRange(0, 300).clone();
  expect_error("back_right", "expected an image of 320 x 200, found 300 x 200");
}

TEST_F(FrontEndTest, SoIsAWrongType) {
  frame_.images[4] = cv::Mat(200, 320, CV_16UC1, cv::Scalar(0));
  expect_error("side", "expected an 8-bit grey or RGB image");
}

TEST_F(FrontEndTest, SoIsAWrongNumberOfImages) {
  frame_.images.pop_back();
  EXPECT_THAT([&] { process(frame_); },
              testing::ThrowsMessage<Error>(
                  testing::HasSubstr("expected 5 images, one a camera of the rig, found 4")));
}

TEST_F(FrontEndTest, TellsTheTimeOfEachStage) {
  process(frame_);
  for (const char* stage : {"features", "stereo", "tags"}) {
    ASSERT_EQ(times_.samples().count(stage), 1u) << stage;
    EXPECT_EQ(times_.samples().at(stage).size(), 1u) << stage;
  }
}

}  // namespace
}  // namespace vinebench::slam
