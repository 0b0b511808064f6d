// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/bag_reader.h"

#include <gmock/gmock.h>

#include "harness/datasets/open_recording.h"
#include "harness/datasets/reading/dataset_reader.h"
#include "tests/support/small_bag.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

class BagReaderTest : public testing::Test {
 protected:
  /// A bag of a pair with two readings, wheels and truth.
  void write_bag(std::int64_t start = 0) const {
    McapOutput out(folder_ / "run.mcap", start);
    std::vector<RosTransform> mounts;
    mounts.push_back(test::mount_of("left_optical_frame", test::optical_at(0, 0.05, 1)));
    mounts.push_back(test::mount_of("right_optical_frame", test::optical_at(0, -0.05, 1)));
    mounts.push_back(test::mount_of("imu", {{}, {0, 0, kHalf, kHalf}}));  // x is the body's y
    out.write_latched("/tf_static", mounts);
    for (int i = 0; i < 2; ++i) {
      const std::int64_t time = test::kBagStart + i * test::kBagPeriod / 2;
      out.write("/imu", RosImu{test::header_at(time, "imu"), {0, 0, 1}, {2, 0, 9.81}, 0, 0});
      out.write("/joint_states", RosJointState{test::header_at(time, ""),
                                               {"rear_right_wheel", "front_left_wheel",
                                                "front_right_wheel", "rear_left_wheel"},
                                               {4, 1, 2, 3},
                                               {0.4, 0.1, 0.2, 0.3}});
    }
    RosOdometry truth;
    truth.header = test::header_at(test::kBagStart, "world");
    truth.pose.position = {5, 6, 7};
    truth.child = "ground_truth";
    out.write("/ground_truth", truth);
    test::write_images(out, test::small_pair());
    out.close();
  }

  std::vector<Sample> play(Recording recording) const {
    WorkerPool pool(2);
    DatasetReader reader(std::move(recording), pool);
    std::vector<Sample> samples;
    while (auto sample = reader.next()) samples.push_back(std::move(*sample));
    return samples;
  }

  const double kHalf = std::sqrt(0.5);
  test::TestFolder folder_;
};

TEST_F(BagReaderTest, AFileAndItsFolderAreTheSameRecording) {
  write_bag();
  for (const fs::path& bag : {folder_.path(), folder_ / "run.mcap"}) {
    const Recording recording = open_recording(bag);
    EXPECT_EQ(recording.format, "ROS 2 bag");
    EXPECT_EQ(recording.name, bag.filename().string());
    ASSERT_EQ(recording.frames.size(), 3u);
    EXPECT_EQ(recording.frames[1].stamp, test::kBagStart + test::kBagPeriod);
    EXPECT_NEAR(recording.rig.rate_hz, 10, 1e-9);
    EXPECT_EQ(recording.rig.cameras[1].name, "right");
    EXPECT_NEAR(recording.rig.baseline(recording.rig.stereo_pairs.at(0)), 0.1, 1e-12);
    const std::vector<Sample> samples = play(recording);
    ASSERT_EQ(samples.size(), 3u);
    EXPECT_EQ(samples[2].frame.images[0].at<std::uint8_t>(5, 5), 2);
    EXPECT_EQ(samples[2].frame.images[1].at<std::uint8_t>(5, 5), 102);
    for (const Sample& sample : samples) {
      for (const SourceEvent& event : sample.events) EXPECT_EQ(event.event, "groundtruth_missing");
    }
  }
}

TEST_F(BagReaderTest, ReadingsAndTruthAreOnTheBody) {
  write_bag();
  const Recording recording = open_recording(folder_.path());
  ASSERT_EQ(recording.imu.size(), 2u);
  EXPECT_EQ(recording.imu[1].stamp, test::kBagStart + test::kBagPeriod / 2);
  EXPECT_LT((recording.imu[0].specific_force - Eigen::Vector3d(0, 2, 9.81)).norm(), 1e-12);
  ASSERT_EQ(recording.wheels.size(), 2u);
  EXPECT_THAT(recording.wheels[0].angle, ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(recording.wheels[0].velocity, ElementsAre(0.1, 0.2, 0.3, 0.4));
  ASSERT_EQ(recording.truth.size(), 1u);
  EXPECT_EQ(recording.truth[0].pose.translation, Eigen::Vector3d(5, 6, 7));
}

TEST_F(BagReaderTest, TruthOfAnotherFrameIsThatOfTheBody) {
  {
    McapOutput out(folder_ / "run.mcap", 0);
    std::vector<RosTransform> mounts;
    mounts.push_back(test::mount_of("left_optical_frame", test::optical_at(0, 0, 0)));
    mounts.push_back(test::mount_of("prism", {{0, 0, 2}, {0, 0, 0, 1}}));
    out.write_latched("/tf_static", mounts);
    RosOdometry truth;
    truth.header = test::header_at(test::kBagStart, "world");
    truth.pose.position = {5, 6, 7};
    truth.child = "prism";
    out.write("/ground_truth", truth);
    test::write_images(out, test::small_pair());
  }
  EXPECT_EQ(open_recording(folder_.path()).truth.at(0).pose.translation, Eigen::Vector3d(5, 6, 5));
}

TEST_F(BagReaderTest, ABagOfSeveralFilesIsOneRecording) {
  const std::int64_t second = test::kBagStart + test::kBagPeriod;
  const std::string bytes(32 * 16, 'x');
  {
    McapOutput first(folder_ / "bag_1.mcap", 0);  // of the pair's first frame
    test::write_images(first, test::small_pair(), 1);
    McapOutput last(folder_ / "bag_0.mcap", 0);
    for (const std::string side : {"left", "right"}) {
      const RosHeader header = test::header_at(second, side + "_optical_frame");
      last.write("/" + side + "/image_rect", RosImage{header, 32, 16, "mono8", bytes});
    }
  }
  folder_.write("metadata.yaml",
                "rosbag2_bagfile_information:\n  relative_file_paths: [bag_1.mcap, bag_0.mcap]\n");
  const std::vector<Sample> samples = play(open_recording(folder_.path()));
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_EQ(samples[0].frame.images[1].at<std::uint8_t>(0, 0), 100);
  EXPECT_EQ(samples[1].frame.images[1].at<std::uint8_t>(0, 0), 'x');
}

TEST_F(BagReaderTest, ReadingsWhosePlaceIsNotKnownAreLeftOut) {
  {
    McapOutput out(folder_ / "run.mcap", 0);
    const RosHeader header = test::header_at(test::kBagStart, "somewhere");
    out.write("/imu", RosImu{header, {0, 0, 1}, {2, 0, 9.81}, 0, 0});
    test::write_images(out, test::small_pair());
  }
  const Recording recording = open_recording(folder_.path());
  EXPECT_TRUE(recording.imu.empty());
  ASSERT_EQ(recording.frames[0].events.size(), 1u);
  EXPECT_EQ(recording.frames[0].events[0].event, "sensor_unplaced");
  EXPECT_THAT(recording.frames[0].events[0].detail, HasSubstr("frame 'somewhere'"));
}

/// Stamps of a recording of ours are those of its run.
TEST_F(BagReaderTest, OurRecordingsHaveTheirOwnStampsAndFiles) {
  write_bag(test::kBagStart);
  folder_.write("frames.csv", "#timestamp [ns]\n0\n50000000\n100000000\n");
  folder_.write("slam.yaml", "");
  const Recording recording = open_recording(folder_ / "run.mcap");
  ASSERT_EQ(recording.frames.size(), 3u);
  EXPECT_EQ(recording.frames[0].stamp, 0);
  EXPECT_EQ(recording.imu[0].stamp, 0);
  EXPECT_EQ(recording.truth[0].stamp, 0);
  EXPECT_TRUE(recording.frames[1].images[0].empty());  // no camera took one then
  EXPECT_EQ(recording.settings, folder_ / "slam.yaml");
}

TEST_F(BagReaderTest, FilesBesideALoneBagOfOthersAreNotItsOwn) {
  write_bag();
  folder_.write("frames.csv", "#timestamp [ns]\n0\n");
  folder_.write("rig.yaml", "not a rig");
  EXPECT_EQ(open_recording(folder_ / "run.mcap").frames.size(), 3u);
  EXPECT_THAT(error_of([&] { open_recording(folder_.path()); }), HasSubstr("rig.yaml"));
}

TEST_F(BagReaderTest, ARigFileReplacesTheCalibration) {
  write_bag();
  const fs::path rig = folder_.write("own.yaml", R"(name: own
cameras:
  - {name: right, width: 32, height: 16, fx: 30, fy: 30}
  - {name: left, width: 32, height: 16, fx: 30, fy: 30, position: [0, 0.2, 0]}
stereo_pairs: [{name: front, left: left, right: right}]
)");
  const Recording recording = open_recording(folder_ / "run.mcap", {.rig = rig, .groundtruth = {}});
  EXPECT_EQ(recording.rig.cameras[0].model.fx, 30);
  // By their names, not by their order.
  EXPECT_EQ(play(recording).at(0).frame.images[0].at<std::uint8_t>(0, 0), 100);
}

TEST_F(BagReaderTest, TopicsCanBeNamed) {
  write_bag();
  RecordingOptions options;
  options.topics = {"/right/image_rect", "/left/image_rect"};
  EXPECT_EQ(open_recording(folder_ / "run.mcap", options).rig.cameras.at(0).name, "right");
  options.topics = {"/left/image_rect"};
  EXPECT_THAT(error_of([&] { open_recording(folder_ / "run.mcap", options); }),
              HasSubstr("expected a stereo pair"));
  fs::create_directories(folder_ / "kitti/image_0");
  EXPECT_THAT(error_of([&] { open_recording(folder_ / "kitti", options); }),
              HasSubstr("--topics are a bag's"));
}

TEST_F(BagReaderTest, ABagThatEndsTooEarlyIsReadUpToThere) {
  write_bag();
  const std::string bytes = read_file(folder_ / "run.mcap");
  fs::create_directories(folder_ / "cut");
  // Chunks of about 300 bytes each; the summary begins after the last one.
  std::size_t frames = 4;
  for (std::size_t size = bytes.size(); size > 0 && frames > 1; size -= 50) {
    const fs::path cut = folder_.write("cut/run.mcap", bytes.substr(0, size));
    Recording recording;
    if (!error_of([&] { recording = open_recording(cut); }).empty()) break;
    EXPECT_LE(recording.frames.size(), frames);
    frames = recording.frames.size();
    if (size == bytes.size()) continue;
    const std::vector<SourceEvent>& events = recording.frames.back().events;
    if (frames < 3) {
      ASSERT_FALSE(events.empty()) << size;
      EXPECT_EQ(events.back().event, "bag_cut_off");
      EXPECT_THAT(events.back().detail, HasSubstr("run.mcap: ends at byte"));
    }
  }
  EXPECT_EQ(frames, 1u);
}

TEST_F(BagReaderTest, BrokenMessagesAreErrorsWithTopicAndPlace) {
  {
    McapWriter out(folder_ / "run.mcap", "test");
    const std::size_t topic = out.add_channel({"/imu", "sensor_msgs/msg/Imu", "", {}, 0});
    out.write(topic, 1, std::string("\0\1\0\0\1", 5));
  }
  const std::string error = error_of([&] { open_recording(folder_ / "run.mcap"); });
  EXPECT_THAT(error, HasSubstr("run.mcap: topic /imu: byte "));
  EXPECT_THAT(error, HasSubstr("of the chunk at byte "));
  EXPECT_THAT(error, HasSubstr("byte 4: expected 4 more bytes, found 1"));
}

TEST_F(BagReaderTest, OneImageThatIsBrokenIsAFaultOfItsFrame) {
  {
    McapOutput out(folder_ / "run.mcap", 0);
    test::write_images(out, test::small_pair(), 2);
    const std::int64_t time = test::kBagStart + 2 * test::kBagPeriod;
    const std::string bytes(32 * 16, 'x');
    out.write("/left/image_rect",
              RosImage{test::header_at(time, "left_optical_frame"), 32, 16, "mono8", bytes});
    out.write("/right/image_rect",
              RosImage{test::header_at(time, "right_optical_frame"), 64, 16, "mono8", "x"});
  }
  const std::vector<Sample> samples = play(open_recording(folder_.path()));
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_TRUE(samples[2].frame.images[1].empty());
  ASSERT_EQ(samples[2].events.size(), 1u);
  EXPECT_EQ(samples[2].events[0].event, "picture_unreadable");
  EXPECT_THAT(samples[2].events[0].detail, HasSubstr("run.mcap:/right/image_rect:"));
}

}  // namespace
}  // namespace vinebench::harness
