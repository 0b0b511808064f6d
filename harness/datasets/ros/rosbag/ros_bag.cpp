// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros/rosbag/ros_bag.h"

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>
#include <set>
#include <system_error>

#include "core/files/disk_room.h"
#include "core/files/output_file.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kEveryMessage = 0;  // chunk threshold, bytes
constexpr std::uint32_t kNoMessage = std::numeric_limits<std::uint32_t>::max();
// Bytes at most that come to a message: of a connection its header with the message's definition,
// of a chunk the messages' places and a line of the index, with what the file's buffer holds.
constexpr std::uint64_t kIndexOfConnection = 16384;
constexpr std::uint64_t kIndexOfChunk = 1024;
constexpr std::uint64_t kIndexOfMessage = 8192;

ros::Time time_of(std::int64_t nanoseconds) {
  ros::Time time;
  return time.fromNSec(static_cast<std::uint64_t>(nanoseconds));
}

std_msgs::Header message(const RosHeader& header) {
  std_msgs::Header m;
  m.stamp = time_of(header.time);
  m.frame_id = header.frame;
  return m;
}

template <class Message>
Message message(const RosVector& v) {
  Message m;
  m.x = v[0];
  m.y = v[1];
  m.z = v[2];
  return m;
}

geometry_msgs::Quaternion message(const RosQuaternion& q) {
  geometry_msgs::Quaternion m;
  m.x = q[0];
  m.y = q[1];
  m.z = q[2];
  m.w = q[3];
  return m;
}

tf2_msgs::TFMessage message(const std::vector<RosTransform>& transforms) {
  tf2_msgs::TFMessage m;
  for (const RosTransform& t : transforms) {
    geometry_msgs::TransformStamped one;
    one.header = message(t.header);
    one.child_frame_id = t.child;
    one.transform.translation = message<geometry_msgs::Vector3>(t.pose.position);
    one.transform.rotation = message(t.pose.rotation);
    m.transforms.push_back(one);
  }
  return m;
}

boost::array<double, 9> diagonal(double variance) {
  return {{variance, 0, 0, 0, variance, 0, 0, 0, variance}};
}

/// Makes rosbag play latch a topic's last message.
template <class Message>
boost::shared_ptr<ros::M_string> latched_connection() {
  auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = ros::message_traits::datatype<Message>();
  (*header)["md5sum"] = ros::message_traits::md5sum<Message>();
  (*header)["message_definition"] = ros::message_traits::definition<Message>();
  (*header)["callerid"] = kRosCaller;
  (*header)["latching"] = "1";
  return header;
}

}  // namespace

struct RosBag::Impl {
  fs::path file;
  fs::path active;
  std::unique_ptr<rosbag::Bag> bag;  ///< null after closing or a failure
  std::set<std::string> topics;
  std::uint64_t chunks = 0;
  bool begun = false;  ///< whether the current chunk has messages

  explicit Impl(const fs::path& name) : file(name), active(name.string() + ".active") {
    expect_room(0);
    create_file(active);  // the library would follow a link of this name
    attempt([&] {
      bag = std::make_unique<rosbag::Bag>();
      bag->open(active.string(), rosbag::bagmode::Write);
      bag->setChunkThreshold(kEveryMessage);
    });
  }

  ~Impl() {
    try {
      close();
    } catch (const Error&) {  // the error was reported before; rosbag reindex recovers the file
    }
  }

  /// After a write error the library cannot close the bag: its destructor would throw and terminate
  /// the program. So it is not destroyed.
  template <class Action>
  void attempt(const Action& action) {
    errno = 0;
    try {
      action();
    } catch (const std::exception& error) {
      const int number = errno;
      static_cast<void>(bag.release());
      fail("{}: cannot be written: {}", active.string(),
           number != 0 ? std::strerror(number) : error.what());
    }
  }

  /// The library would detect it only when there is no space for the index.
  void expect_room(std::uint64_t bytes) const {
    const std::uint64_t index = (topics.size() + 1) * kIndexOfConnection + chunks * kIndexOfChunk;
    const int reason = lack_of_room(active, bytes + kIndexOfMessage + index);
    if (reason != 0) fail("{}: cannot be written: {}", file.string(), std::strerror(reason));
  }

  template <class Message>
  void write(const std::string& topic, std::int64_t time, const Message& m,
             const boost::shared_ptr<ros::M_string>& connection = {}) {
    if (!bag) fail("{}: is closed", file.string());
    topics.insert(topic);
    expect_room(ros::serialization::serializationLength(m));
    attempt([&] {
      bag->write(topic, time_of(time), m, connection);
      // The library releases its copy of a chunk only if a message exceeds the threshold. So the
      // first one of each frame does, in a separate chunk.
      if (!begun) bag->setChunkThreshold(kNoMessage);
    });
    begun = true;
  }

  void end_chunk() {
    if (!begun) return;
    attempt([&] { bag->setChunkThreshold(kEveryMessage); });
    // The library cannot flush the chunk's index; this flushes all files.
    std::fflush(nullptr);
    begun = false;
    chunks += 2;
  }

  void close() {
    if (!bag) return;
    attempt([&] { bag->close(); });
    bag.reset();
    std::error_code error;
    fs::rename(active, file, error);
    if (error) fail("{}: cannot be renamed: {}", active.string(), error.message());
  }
};

RosBag::RosBag(const fs::path& file) : impl_(std::make_unique<Impl>(file)) {}

RosBag::~RosBag() = default;

void RosBag::write_clock(const std::string& topic, std::int64_t time) {
  rosgraph_msgs::Clock m;
  m.clock = time_of(time);
  impl_->write(topic, time, m);
}

void RosBag::write_transforms(const std::string& topic,
                              const std::vector<RosTransform>& transforms) {
  if (transforms.empty()) return;
  impl_->write(topic, transforms.front().header.time, message(transforms));
}

void RosBag::write_latched(const std::string& topic, const std::vector<RosTransform>& transforms) {
  if (transforms.empty()) return;
  impl_->write(topic, transforms.front().header.time, message(transforms),
               latched_connection<tf2_msgs::TFMessage>());
}

void RosBag::write(const std::string& topic, const RosImage& image) {
  sensor_msgs::Image m;
  m.header = message(image.header);
  m.width = static_cast<std::uint32_t>(image.width);
  m.height = static_cast<std::uint32_t>(image.height);
  m.encoding = image.encoding;
  m.step = image.height > 0 ? static_cast<std::uint32_t>(image.bytes.size()) / m.height : 0;
  m.data.assign(image.bytes.begin(), image.bytes.end());
  impl_->write(topic, image.header.time, m);
}

void RosBag::write(const std::string& topic, const RosCompressedImage& image) {
  sensor_msgs::CompressedImage m;
  m.header = message(image.header);
  m.format = image.format;
  m.data.assign(image.bytes.begin(), image.bytes.end());
  impl_->write(topic, image.header.time, m);
}

void RosBag::write(const std::string& topic, const RosCameraInfo& info) {
  sensor_msgs::CameraInfo m;
  m.header = message(info.header);
  m.width = static_cast<std::uint32_t>(info.width);
  m.height = static_cast<std::uint32_t>(info.height);
  m.distortion_model = info.model;
  m.D.assign(info.D.begin(), info.D.end());
  std::copy(info.K.begin(), info.K.end(), m.K.begin());
  std::copy(info.R.begin(), info.R.end(), m.R.begin());
  std::copy(info.P.begin(), info.P.end(), m.P.begin());
  impl_->write(topic, info.header.time, m);
}

void RosBag::write(const std::string& topic, const RosImu& reading) {
  sensor_msgs::Imu m;
  m.header = message(reading.header);
  m.orientation.w = 1;
  m.orientation_covariance[0] = -1;  // ROS: there is no orientation
  m.angular_velocity = message<geometry_msgs::Vector3>(reading.angular_velocity);
  m.angular_velocity_covariance = diagonal(reading.angular_velocity_variance);
  m.linear_acceleration = message<geometry_msgs::Vector3>(reading.linear_acceleration);
  m.linear_acceleration_covariance = diagonal(reading.linear_acceleration_variance);
  impl_->write(topic, reading.header.time, m);
}

void RosBag::write(const std::string& topic, const RosJointState& reading) {
  sensor_msgs::JointState m;
  m.header = message(reading.header);
  m.name = reading.names;
  m.position = reading.positions;
  m.velocity = reading.velocities;
  impl_->write(topic, reading.header.time, m);
}

void RosBag::write(const std::string& topic, const RosOdometry& odometry) {
  nav_msgs::Odometry m;
  m.header = message(odometry.header);
  m.child_frame_id = odometry.child;
  m.pose.pose.position = message<geometry_msgs::Point>(odometry.pose.position);
  m.pose.pose.orientation = message(odometry.pose.rotation);
  m.twist.twist.linear = message<geometry_msgs::Vector3>(odometry.velocity);
  m.twist.twist.angular = message<geometry_msgs::Vector3>(odometry.angular_velocity);
  impl_->write(topic, odometry.header.time, m);
}

void RosBag::end_chunk() {
  impl_->end_chunk();
}

void RosBag::close() {
  impl_->close();
}

bool has_rosbag() {
  return true;
}

}  // namespace vinebench::harness
