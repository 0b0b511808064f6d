// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/ros1_file.h"

#include <gmock/gmock.h>

#include "harness/datasets/open_recording.h"
#include "harness/datasets/ros2/mcap/mcap_fields.h"
#include "tests/support/compressed.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;
using namespace std::string_literals;

/// Numbers as ROS 1 has them: little-endian.
template <class T>
std::string raw(T value) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  return {bytes.data(), bytes.size()};
}

std::string with_length(const std::string& bytes) {
  return raw(static_cast<std::uint32_t>(bytes.size())) + bytes;
}

std::string field(const std::string& name, const std::string& value) {
  return with_length(name + "=" + value);
}

std::string record(const std::string& header, const std::string& data) {
  return with_length(header) + with_length(data);
}

std::string connection(std::uint32_t id, const std::string& topic, const std::string& type,
                       const std::string& caller = "/rosbag") {
  return record(field("op", "\7") + field("conn", raw(id)) + field("topic", topic),
                field("topic", topic) + field("type", type) + field("md5sum", "*") +
                    field("message_definition", "") + field("callerid", caller));
}

std::string message(std::uint32_t id, const std::string& data) {
  return record(field("op", "\2") + field("conn", raw(id)) + field("time", raw(std::uint64_t{0})),
                data);
}

std::string chunk(const std::string& compression, const std::string& data, std::size_t size) {
  return record(field("op", "\5") + field("compression", compression) +
                    field("size", raw(static_cast<std::uint32_t>(size))),
                data);
}

std::string bag(const std::string& records) {
  const std::string head = record(field("op", "\3") + field("index_pos", raw(std::uint64_t{0})) +
                                      field("conn_count", raw(0u)) + field("chunk_count", raw(0u)),
                                  std::string(64, ' '));
  return "#ROSBAG V2.0\n" + head + records;
}

/// A header of ROS 1, with its running number.
std::string header(std::uint32_t tenths, const std::string& frame) {
  return raw(7u) + raw(5u) + raw(tenths * 100'000'000u) + with_length(frame);
}

std::string image(std::uint32_t tenths, const std::string& frame, int grey) {
  return header(tenths, frame) + raw(16u) + raw(32u) + with_length("mono8") + "\0"s + raw(32u) +
         with_length(std::string(16 * 32, static_cast<char>(grey)));
}

template <std::size_t N>
std::string numbers(const std::array<double, N>& values) {
  std::string bytes;
  for (const double value : values) bytes += raw(value);
  return bytes;
}

std::string calibration(const std::string& frame, double shift) {
  return header(0, frame) + raw(16u) + raw(32u) + with_length("plumb_bob") + raw(5u) +
         numbers<5>({}) + numbers<9>({20, 0, 15.5, 0, 20, 7.5, 0, 0, 1}) +
         numbers<9>({1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         numbers<12>({20, 0, 15.5, shift, 0, 20, 7.5, 0, 0, 0, 1, 0}) + raw(0u) + raw(0u) +
         std::string(17, '\0');
}

class Ros1FileTest : public testing::Test {
 protected:
  fs::path file(const std::string& bytes) const { return folder_.write("a.bag", bytes); }

  /// "topic type data" of each message, read twice.
  std::vector<std::string> messages(const std::string& bytes) {
    Ros1File in(file(bytes));
    std::vector<std::string> found;
    std::vector<std::pair<MessagePlace, std::string>> places;
    in.scan([&](const BagMessage& m) {
      EXPECT_EQ(m.coding, MessageCoding::kRos1);
      found.push_back(fmt::format("{} {} {}", m.topic, m.type, m.data));
      places.emplace_back(m.place, m.data);
    });
    for (const auto& [place, data] : places) EXPECT_EQ(in.read(place), data);
    cut_off_ = in.cut_off();
    start_ = in.start();
    return found;
  }
  std::string problem(const std::string& records) {
    const std::string error = error_of([&] { messages(bag(records)); });
    EXPECT_THAT(error, HasSubstr("a.bag"));
    return error;
  }

  test::TestFolder folder_;
  std::string cut_off_;
  std::int64_t start_ = 0;
};

TEST_F(Ros1FileTest, MessagesAreFoundInAndOutsideOfChunks) {
  const std::string all =
      connection(3, "/a", "std_msgs/String") + message(3, "x") + message(3, "yz");
  const auto both = ElementsAre("/a std_msgs/msg/String x", "/a std_msgs/msg/String yz");
  EXPECT_THAT(messages(bag(all)), both);
  EXPECT_THAT(messages(bag(chunk("none", all, all.size()))), both);
  EXPECT_THAT(messages(bag(chunk("lz4", test::lz4_frame(all), all.size()))), both);
  EXPECT_THAT(messages(bag(chunk("bz2", test::bz2_stream(all), all.size()))), both);
  // Connections count from one chunk to the next; the index repeats them.
  const std::string second = message(3, "w");
  EXPECT_THAT(messages(bag(chunk("none", all, all.size()) + chunk("none", second, second.size()) +
                           connection(3, "/a", "std_msgs/String"))),
              ElementsAre("/a std_msgs/msg/String x", "/a std_msgs/msg/String yz",
                          "/a std_msgs/msg/String w"));
  EXPECT_EQ(cut_off_, "");
  EXPECT_EQ(start_, 0);
}

TEST_F(Ros1FileTest, OursIsAheadOfItsStamps) {
  messages(bag(connection(0, "/tf_static", "tf2_msgs/TFMessage", "/vinebench")));
  EXPECT_EQ(start_, 1'000'000'000);
}

TEST_F(Ros1FileTest, AFileThatEndsTooEarlyIsReadUpToThere) {
  const std::string whole = bag(connection(3, "/a", "T") + message(3, "x"));
  for (const std::size_t more : {1u, 4u, 10u, 60u}) {
    EXPECT_THAT(messages(whole + message(3, std::string(20, 'y')).substr(0, more)),
                ElementsAre("/a T x"));
    EXPECT_EQ(cut_off_, fmt::format("ends at byte {}, in the record at byte {}",
                                    whole.size() + more, whole.size()));
  }
}

TEST_F(Ros1FileTest, WhatIsBrokenIsAnErrorWithItsPlace) {
  for (const char* content : {"", "#ROSBAG V1.2\n", "\x89MCAP0\r\n    "}) {
    EXPECT_THAT(error_of([&] { messages(content); }), HasSubstr("expected a bag of ROS 1"));
  }
  const std::string all = connection(3, "/a", "T") + message(4, "x");
  EXPECT_THAT(problem(all), HasSubstr("expected one of the connections before it, found 4"));
  EXPECT_THAT(problem(chunk("none", all, all.size())), HasSubstr("connections before it, found 4"));
  EXPECT_THAT(problem(chunk("bz2", "noise", 9)), HasSubstr("bz2: the data are damaged"));
  EXPECT_THAT(problem(chunk("xz", "noise", 9)), HasSubstr("or bz2, found 'xz'"));
  EXPECT_THAT(problem(chunk("lz4", test::lz4_frame(all), all.size() + 1)),
              HasSubstr("bytes without compression, found"));
  EXPECT_THAT(problem(chunk("bz2", "noise", 0xffffffff)),
              HasSubstr("expected a chunk of at most 268435456 bytes"));
  EXPECT_THAT(problem(chunk("none", all.substr(0, 20), 20)), HasSubstr("more bytes in the record"));
  EXPECT_THAT(problem(record(field("op", "\2"), "x")), HasSubstr("expected a field 'conn'"));
  EXPECT_THAT(problem(record(with_length("op"), "x")), HasSubstr("expected a field 'name=value'"));
  EXPECT_THAT(problem(record(field("op", "\2") + field("conn", "12"), "x")),
              HasSubstr("conn: expected 4 bytes, found 2"));
  EXPECT_THAT(problem(raw(0x7fffffffu) + std::string(8, 'x')),
              HasSubstr("expected a header of at"));
}

TEST_F(Ros1FileTest, AStereoPairIsReplayed) {
  std::string records;
  std::uint32_t id = 0;
  for (const std::string side : {"left", "right"}) {
    const bool right = side == "right";
    records += connection(id, "/" + side + "/camera_info", "sensor_msgs/CameraInfo");
    // P[3] = -20 px times 0.1 m
    records += message(id++, calibration(side, right ? -2 : 0));
    records += connection(id, "/" + side + "/image_rect", "sensor_msgs/Image");
    for (std::uint32_t i = 0; i < 3; ++i) {
      records += message(id, image(i, side, static_cast<int>(i) + (right ? 100 : 0)));
    }
    ++id;
  }
  records += connection(id, "/imu", "sensor_msgs/Imu");
  records += message(id, header(1, "left") + numbers<4>({0, 0, 0, 1}) + numbers<9>({}) +
                             numbers<3>({0.1, 0.2, 0.3}) + numbers<9>({}) +
                             numbers<3>({1, 2, 9.81}) + numbers<9>({}));
  file(bag(chunk("bz2", test::bz2_stream(records), records.size())));
  for (const fs::path& named : {folder_ / "a.bag", folder_.path()}) {
    const Recording recording = open_recording(named);
    EXPECT_EQ(recording.format, "ROS 1 bag");
    ASSERT_EQ(recording.frames.size(), 3u);
    EXPECT_EQ(recording.frames[1].stamp, 5'100'000'000);
    EXPECT_NEAR(recording.rig.baseline(recording.rig.stereo_pairs.at(0)), 0.1, 1e-12);
    const auto grey = [&](std::size_t frame, std::size_t camera) {
      return recording.store->read_grey(recording.frames[frame].images[camera])
          .at<std::uint8_t>(3, 4);
    };
    EXPECT_EQ(grey(2, 0), 2);
    EXPECT_EQ(grey(1, 1), 101);
    ASSERT_EQ(recording.imu.size(), 1u);
    // The unit has the left camera's axes: its z, ahead, is the body's x.
    EXPECT_NEAR(recording.imu[0].specific_force.x(), 9.81, 1e-12);
    EXPECT_NEAR(recording.imu[0].angular_velocity.y(), -0.1, 1e-12);
  }
}

TEST_F(Ros1FileTest, ABagThatEndsBeforeItsImagesSaysSo) {
  const std::string records =
      connection(0, "/clock", "rosgraph_msgs/Clock") + message(0, "12345678");
  const fs::path cut = file(bag(records) + "\5");
  EXPECT_THAT(error_of([&] { open_recording(cut); }),
              testing::AllOf(HasSubstr("found /clock"), HasSubstr("a.bag: ends at byte ")));
}

// EuRoC's own bags have images and readings alone.
TEST_F(Ros1FileTest, AChainOfKalibrIsTheCalibrationOfABagWithoutOne) {
  std::string records;
  for (std::uint32_t camera = 0; camera < 2; ++camera) {
    records += connection(camera, fmt::format("/cam{}/image_raw", camera), "sensor_msgs/Image");
    records += message(camera, image(0, fmt::format("cam{}", camera), 10));
  }
  records += connection(2, "/imu0", "sensor_msgs/Imu");
  records += message(2, header(0, "imu4") + numbers<4>({0, 0, 0, 1}) + numbers<9>({}) +
                            numbers<3>({0.1, 0.2, 0.3}) + numbers<9>({}) +
                            numbers<3>({1, 2, 9.81}) + numbers<9>({}));
  file(bag(records));
  std::string chain;
  for (const double right : {0.0, 0.1}) {
    chain += fmt::format(
        "cam{}:\n  T_cam_imu: [[1, 0, 0, {}], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n"
        "  camera_model: pinhole\n  distortion_coeffs: [0.1, 0, 0, 0]\n"
        "  distortion_model: radtan\n  intrinsics: [20, 20, 15.5, 7.5]\n  resolution: [32, 16]\n",
        right > 0 ? 1 : 0, -right);
  }
  const fs::path rig = folder_.write("chain.yaml", chain);
  EXPECT_NE(error_of([&] { open_recording(folder_ / "a.bag"); }), "");
  const Recording recording = open_recording(folder_ / "a.bag", {.rig = rig, .groundtruth = {}});
  EXPECT_NEAR(recording.rig.baseline(recording.rig.stereo_pairs.at(0)), 0.1, 1e-12);
  ASSERT_EQ(recording.imu.size(), 1u);
  EXPECT_NEAR(recording.imu[0].specific_force.z(), 9.81, 1e-12);
}

}  // namespace
}  // namespace vinebench::harness
