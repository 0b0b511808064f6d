// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/bag_contents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/util/error.h"
#include "harness/datasets/ros2/bag/ros1_file.h"
#include "harness/datasets/ros2/bag/sqlite_file.h"
#include "harness/datasets/ros2/cdr/ros2_messages.h"
#include "harness/datasets/ros2/mcap/mcap_file.h"

namespace vinebench::harness {
namespace {

// Readings and images of a bag at most: a small file can unpack to a great number of them.
constexpr std::uint64_t kMostReadings = 20'000'000;
constexpr std::uint64_t kMostImages = 4'000'000;

template <std::size_t N>
void expect_finite(const std::array<double, N>& numbers, const char* what) {
  if (std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); })) return;
  fail("{}: expected finite numbers", what);
}

void expect_pose(const RosTransform& transform) {
  constexpr double kNormTolerance = 0.01;  // of a quaternion's norm
  expect_finite(transform.pose.position, "position");
  expect_finite(transform.pose.rotation, "rotation");
  double square = 0;
  for (const double q : transform.pose.rotation) square += q * q;
  if (std::abs(std::sqrt(square) - 1) > kNormTolerance) {
    fail("expected a unit quaternion, found norm {}", std::sqrt(square));
  }
}

std::optional<WheelSample> wheels_of(const RosJointState& state, Stamp stamp) {
  static const std::array<std::string, 4> names{"front_left_wheel", "front_right_wheel",
                                                "rear_left_wheel", "rear_right_wheel"};
  WheelSample sample;
  sample.stamp = stamp;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::ranges::find(state.names, names[i]);
    const auto joint = static_cast<std::size_t>(found - state.names.begin());
    if (found == state.names.end() || joint >= state.positions.size() ||
        joint >= state.velocities.size()) {
      return std::nullopt;
    }
    sample.angle[i] = state.positions[joint];
    sample.velocity[i] = state.velocities[joint];
  }
  expect_finite(sample.angle, "angles");
  expect_finite(sample.velocity, "rates");
  return sample;
}

/// Puts messages into the contents.
class Collector {
 public:
  explicit Collector(BagContents& contents) : contents_(contents) {}

  void take(std::size_t file, const BagMessage& message) {
    contents_.topics.try_emplace(message.topic, message.type);
    start_ = contents_.files[file]->start();
    try {
      take_message(file, message);
    } catch (const Error& error) {
      fail("{}: topic {}: {}: {}", contents_.names[file].string(), message.topic,
           contents_.files[file]->describe(message.place), error.what());
    }
  }

 private:
  void take_message(std::size_t file, const BagMessage& message) {
    const std::string& type = message.type;
    if (type == ros2::kImage || type == ros2::kCompressedImage) return take_image(file, message);
    if (type == ros2::kCameraInfo) return take_camera(message);
    if (type == ros2::kImu) return take_inertial(message);
    if (message.topic == "/tf_static") return take_mounts(message);
    if (message.topic == "/joint_states" && type == ros2::kJointState) return take_wheels(message);
    if (message.topic == "/ground_truth") return take_truth(message);
  }

  void count() {
    if (++readings_ > kMostReadings) fail("expected at most {} readings", kMostReadings);
  }

  Stamp stamp_of(const RosHeader& header) const { return header.time - start_; }

  void take_image(std::size_t file, const BagMessage& message) {
    if (++images_ > kMostImages) fail("expected at most {} images", kMostImages);
    BagImages& images = contents_.images[message.topic];
    const RosHeader header = decode_header(message.encoded());
    if (images.entries.empty()) {
      images.type = message.type;
      images.frame = header.frame;
      images.coding = message.type == ros2::kImage
                          ? decode_image(message.encoded()).encoding
                          : decode_compressed_image(message.encoded()).format;
    }
    if (images.type != message.type) fail("expected {}, found {}", images.type, message.type);
    images.entries.push_back({stamp_of(header), file, message.place});
  }

  void take_camera(const BagMessage& message) {
    if (contents_.cameras.contains(message.topic)) return;
    contents_.cameras[message.topic] = decode_camera_info(message.encoded());
  }

  void take_inertial(const BagMessage& message) {
    count();
    const RosImu reading = decode_imu(message.encoded());
    expect_finite(reading.angular_velocity, "angular velocity");
    expect_finite(reading.linear_acceleration, "acceleration");
    BagInertial& inertial = contents_.inertial[message.topic];
    if (inertial.readings.empty()) inertial.frame = reading.header.frame;
    inertial.readings.push_back({stamp_of(reading.header),
                                 Eigen::Vector3d(reading.angular_velocity.data()),
                                 Eigen::Vector3d(reading.linear_acceleration.data())});
  }

  void take_mounts(const BagMessage& message) {
    for (const RosTransform& mount : decode_transforms(message.encoded())) {
      count();
      expect_pose(mount);
      contents_.mounts.push_back(mount);
    }
  }

  void take_wheels(const BagMessage& message) {
    count();
    const RosJointState state = decode_joint_state(message.encoded());
    if (const auto wheels = wheels_of(state, stamp_of(state.header))) {
      contents_.wheels.push_back(*wheels);
    }
  }

  void take_truth(const BagMessage& message) {
    count();
    RosTransform pose = decode_pose(message.type, message.encoded());
    expect_pose(pose);
    pose.header.time = stamp_of(pose.header);
    contents_.truth.push_back(std::move(pose));
  }

  BagContents& contents_;
  Stamp start_ = 0;
  std::uint64_t readings_ = 0;
  std::uint64_t images_ = 0;
};

/// By the name's ending.
std::shared_ptr<BagFile> open_bag_file(const std::filesystem::path& file) {
  if (file.extension() == ".mcap") return std::make_shared<McapFile>(file);
  if (file.extension() == ".db3") return std::make_shared<SqliteFile>(file);
  if (file.extension() == ".bag") return std::make_shared<Ros1File>(file);
  fail("{}: expected a name that ends in .mcap, .db3 or .bag", file.string());
}

}  // namespace

BagContents scan_bag(const std::vector<std::filesystem::path>& files) {
  BagContents contents;
  contents.names = files;
  Collector collector(contents);
  for (std::size_t i = 0; i < files.size(); ++i) {
    contents.files.push_back(open_bag_file(files[i]));
    contents.files[i]->scan([&](const BagMessage& message) { collector.take(i, message); });
    contents.ours = contents.ours || contents.files[i]->start() != 0;
    const std::string cut_off = contents.files[i]->cut_off();
    if (!cut_off.empty()) contents.cut_off = files[i].string() + ": " + cut_off;
  }
  return contents;
}

}  // namespace vinebench::harness
