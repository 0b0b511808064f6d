// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/euroc_sink.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/util/random.h"
#include "harness/datasets/euroc/tag_list.h"
#include "harness/datasets/files/background_worker.h"
#include "harness/replay.h"
#include "tests/support/recorded_folders.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;

constexpr std::int64_t kFrames = 6;

/// A pair and a tag camera, at arbitrary angles.
RecordingNotes notes() {
  RecordingNotes notes;
  for (const char* name : {"left", "right", "side"}) {
    RigConfig::Camera camera;
    camera.name = name;
    camera.width = test::kWidth;
    camera.height = test::kHeight;
    camera.fx = 20.1;
    camera.position = {0.1, -0.07 * static_cast<double>(notes.rig.cameras.size()), 1.0 / 3};
    camera.rpy_deg = {0.1, 12.7, 33.3};
    notes.rig.cameras.push_back(camera);
  }
  notes.rig.rate_hz = 15;
  notes.rig.stereo_pairs = {{"front", "left", "right"}};
  notes.rig.tag_cameras = {"side"};
  notes.tags.push_back(
      {"tag36h11", 7, 0.161, {from_roll_pitch_yaw({0.1, 0.2, 0.3}), {1, 2, 1.0 / 7}}});
  notes.slam.features.features = 777;
  notes.scenario = "test";
  return notes;
}

cv::Mat noise_image(std::int64_t index, std::size_t camera) {
  const RandomStream stream(7, "pictures", static_cast<std::uint64_t>(10 * index) + camera);
  cv::Mat image(test::kHeight, test::kWidth, CV_8UC3);
  for (int i = 0; i < 3 * test::kWidth * test::kHeight; ++i) {
    image.data[i] = static_cast<std::uint8_t>(stream.bits(static_cast<std::uint64_t>(i)));
  }
  return image;
}

/// Every value has many digits. The first camera misses frame 2.
Sample sample(std::int64_t index) {
  Sample sample;
  sample.frame.index = index;
  sample.frame.stamp = stamp_of_frame(index, 15);
  for (std::size_t camera = 0; camera < 3; ++camera) {
    const bool dropped = index == 2 && camera == 0;
    sample.frame.images.push_back(dropped ? cv::Mat() : noise_image(index, camera));
  }
  const double t = to_seconds(sample.frame.stamp);
  sample.frame.imu = {{sample.frame.stamp - 5, {t / 3, 1.0 / 3, -t}, {0.1, t / 7, 9.81}},
                      {sample.frame.stamp, {t, 2.0 / 3, 1e-17}, {0.2, t / 9, 9.82}}};
  sample.frame.wheels = {{sample.frame.stamp, {t, t / 3, t / 7, 1}, {0.1, 1e-9, t, -t / 11}}};
  sample.truth.T_world_body = {from_roll_pitch_yaw({0.01, t / 3, t}), {2 * t, t / 3, 0.5}};
  return sample;
}

cv::Mat grey_of(const cv::Mat& rgb) {
  cv::Mat grey;
  if (!rgb.empty()) cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

bool same_image(const cv::Mat& a, const cv::Mat& b) {
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

class EurocSinkTest : public testing::Test {
 protected:
  void write(std::int64_t frames = kFrames) {
    EurocSink writer(root_, notes());
    for (std::int64_t i = 0; i < frames; ++i) writer.on_tick(sample(i), {});
    writer.on_finish({});
  }

  test::TestFolder folder_;
  std::filesystem::path root_ = folder_ / "recording";
};

TEST_F(EurocSinkTest, WhatIsReadBackIsWhatTheSlamSystemSaw) {
  write();
  const std::vector<Sample> samples = test::play_all(root_);
  ASSERT_EQ(samples.size(), static_cast<std::size_t>(kFrames));
  for (std::int64_t i = 0; i < kFrames; ++i) {
    const Frame expected = sample(i).frame;
    const Frame& frame = samples[static_cast<std::size_t>(i)].frame;
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(frame.stamp, expected.stamp);
    for (std::size_t camera = 0; camera < 3; ++camera) {
      EXPECT_TRUE(same_image(frame.images[camera], grey_of(expected.images[camera])));
    }
    ASSERT_EQ(frame.imu.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(frame.imu[k].stamp, expected.imu[k].stamp);
      EXPECT_EQ(frame.imu[k].angular_velocity, expected.imu[k].angular_velocity);
      EXPECT_EQ(frame.imu[k].specific_force, expected.imu[k].specific_force);
    }
    ASSERT_EQ(frame.wheels.size(), 1u);
    EXPECT_EQ(frame.wheels[0].angle, expected.wheels[0].angle);
    EXPECT_EQ(frame.wheels[0].velocity, expected.wheels[0].velocity);
    const Pose error = sample(i).truth.T_world_body.inverse() *
                       samples[static_cast<std::size_t>(i)].truth.T_world_body;
    EXPECT_LT((error.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
  }
  EXPECT_EQ(test::count_events(samples), (std::map<std::string, int>{{"picture_missing", 1}}));
}

TEST_F(EurocSinkTest, RigTagsAndSettingsComeBackToTheBit) {
  write();
  const Recording recording = open_recording(root_);
  const Rig rig = notes().rig.make();
  ASSERT_EQ(recording.rig.cameras.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(recording.rig.cameras[i].name, rig.cameras[i].name);
    EXPECT_EQ(recording.rig.cameras[i].model.fx, rig.cameras[i].model.fx);
    EXPECT_EQ(recording.rig.cameras[i].T_body_cam.rotation.coeffs(),
              rig.cameras[i].T_body_cam.rotation.coeffs());
    EXPECT_EQ(recording.rig.cameras[i].T_body_cam.translation,
              rig.cameras[i].T_body_cam.translation);
  }
  EXPECT_EQ(recording.rig.tag_cameras, std::vector<int>{2});
  ASSERT_EQ(recording.tags.size(), 1u);
  const RegisteredTag expected = notes().tags[0];
  EXPECT_EQ(recording.tags[0].id, 7);
  EXPECT_EQ(recording.tags[0].size, expected.size);
  EXPECT_EQ(recording.tags[0].T_world_tag.rotation.coeffs(),
            expected.T_world_tag.rotation.coeffs());
  EXPECT_EQ(recording.tags[0].T_world_tag.translation, expected.T_world_tag.translation);
  EXPECT_EQ(replay_settings(recording, "", {}).features.features, 777);
  EXPECT_EQ(replay_settings(recording, "", {{"slam.features.features", "888"}}).features.features,
            888);
}

TEST_F(EurocSinkTest, OthersReadItWithoutWhatIsOurs) {
  write();
  for (const char* ours : {"rig.yaml", "tags.yaml", "slam.yaml", "frames.csv"}) {
    std::filesystem::remove(root_ / ours);
  }
  const Recording recording = open_recording(root_);
  // cam0 lacks a frame, which is reported as a gap.
  EXPECT_EQ(recording.frames.size(), static_cast<std::size_t>(kFrames - 1));
  EXPECT_EQ(recording.frames[2].events.at(0).event, "frames_missing");
  const Pose difference =
      notes().rig.make().cameras[2].T_body_cam.inverse() * recording.rig.cameras[2].T_body_cam;
  EXPECT_LT((difference.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
  const std::string list = read_file(root_ / "mav0/cam1/data.csv");
  EXPECT_THAT(list, testing::StartsWith("#timestamp [ns],filename\n"
                                        "0000000000000000000,0000000000000000000.png\n"
                                        "0000000000066666667,0000000000066666667.png\n"));
  const std::string truth = read_file(root_ / "mav0/state_groundtruth_estimate0/data.csv");
  EXPECT_EQ(std::ranges::count(truth, '\n'), kFrames + 1);
  EXPECT_EQ(std::ranges::count(truth.substr(truth.rfind('\n', truth.size() - 2)), ','), 16);
  // The mean speed along x is 2 m/s, at the ends and between.
  EXPECT_THAT(truth, HasSubstr(",0,0,0,0,0,0\n"));
}

TEST_F(EurocSinkTest, AnInterruptedRecordingCanBeRead) {
  {
    EurocSink writer(root_, notes());
    for (std::int64_t i = 0; i < 4; ++i) writer.on_tick(sample(i), {});
  }
  EXPECT_EQ(open_recording(root_).frames.size(), 4u);
}

TEST_F(EurocSinkTest, ACameraThatNeverDeliveredIsBlind) {
  write();
  test::write_text(root_ / "mav0/cam2/data.csv", "#timestamp [ns],filename\n");
  const std::vector<Sample> samples = test::play_all(root_);
  ASSERT_EQ(samples.size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(test::count_events(samples).at("picture_missing"), kFrames + 1);
  test::write_text(root_ / "frames.csv", "#timestamp [ns]\n");
  EXPECT_THAT(error_of([&] { open_recording(root_); }),
              HasSubstr("frames.csv: expected a line for each frame"));
}

TEST_F(EurocSinkTest, AFolderThatHasSomethingIsAnError) {
  test::write_text(root_ / "precious.txt", "data");
  EXPECT_THAT(error_of([&] { EurocSink(root_, notes()); }), HasSubstr("is not empty"));
  EXPECT_EQ(read_file(root_ / "precious.txt"), "data");
  EXPECT_FALSE(std::filesystem::exists(root_ / "mav0"));
  EXPECT_THAT(error_of([&] { EurocSink(root_ / "precious.txt" / "sub", notes()); }),
              HasSubstr("cannot be created: Not a directory"));
}

TEST_F(EurocSinkTest, ADiskThatTakesNoMoreIsOneError) {
  EurocSink writer(root_, notes());
  writer.on_tick(sample(0), {});
  // The images' folder is removed, as if the disk were full or unplugged.
  const std::string error = error_of([&] {
    for (std::int64_t i = 1; i < 1000; ++i) {
      if (i == 3) std::filesystem::remove_all(root_ / "mav0/cam1");
      writer.on_tick(sample(i), {});
    }
  });
  EXPECT_THAT(error, HasSubstr("cannot be written: No such file or directory"));
}

TEST(BackgroundWorkerTest, DoesJobsInOrderAndTellsTheFirstFault) {
  std::vector<int> done;
  BackgroundWorker worker(2);
  for (int i = 0; i < 50; ++i) worker.submit([&done, i] { done.push_back(i); });
  worker.wait();
  ASSERT_EQ(done.size(), 50u);
  EXPECT_TRUE(std::ranges::is_sorted(done));
  worker.submit([] { fail("first"); });
  EXPECT_EQ(error_of([&] { worker.wait(); }), "first");
  EXPECT_EQ(error_of([&] { worker.submit([&] { done.push_back(-1); }); }), "first");
  EXPECT_EQ(done.size(), 50u);
}

TEST(TagListTest, WhatIsWrittenIsRead) {
  const test::TestFolder folder;
  const Pose T_world_tag{exp_so3({0.1, -0.2, 0.3}), {1, 2, 0.5}};
  const std::vector<RegisteredTag> written = {{"tag36h11", 7, 0.2, T_world_tag, {0.01, 0.02}}};
  const auto read = read_tags(folder.write("tags.yaml", format_tags(written)));
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].id, 7);
  EXPECT_EQ(read[0].size, 0.2);
  EXPECT_EQ(read[0].T_world_tag.translation, T_world_tag.translation);
  EXPECT_EQ(read[0].T_world_tag.rotation.coeffs(), T_world_tag.rotation.coeffs());
  EXPECT_EQ(read[0].survey.position, 0.01);
  EXPECT_NEAR(read[0].survey.rotation, 0.02, 1e-15);  // by way of degrees
  // Nobody has to say how well it was surveyed.
  EXPECT_EQ(read_tags(folder.write("plain.yaml", "tags: [{id: 1}]"))[0].survey.position, 0);
}

TEST(TagListTest, FaultsNameFileAndKey) {
  const test::TestFolder folder;
  const auto error = [&](const std::string& text) {
    return error_of([&] { read_tags(folder.write("tags.yaml", text)); });
  };
  EXPECT_THAT(error("tags: [{id: 1, size: 0}]"), HasSubstr("tags.yaml:1: tags.0.size"));
  EXPECT_THAT(error("tags: [{id: 1, rotation: [1, 1, 0, 0]}]"), HasSubstr("unit quaternion"));
}

}  // namespace
}  // namespace vinebench::harness
