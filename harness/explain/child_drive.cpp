// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/child_drive.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>

#include "core/util/error.h"
#include "harness/systems/host/wire.h"

namespace vinebench::harness {
namespace {

void add_vector(MessageWriter& message, const Eigen::Vector3d& v) {
  for (int i = 0; i < 3; ++i) message.add(v[i]);
}

Eigen::Vector3d read_vector(MessageReader& message) {
  Eigen::Vector3d v;
  for (int i = 0; i < 3; ++i) v[i] = message.read<double>();
  return v;
}

void add_pose(MessageWriter& message, const Pose& pose) {
  add_vector(message, pose.translation);
  for (int i = 0; i < 4; ++i) message.add(pose.rotation.coeffs()[i]);
}

Pose read_pose(MessageReader& message) {
  Pose pose;
  pose.translation = read_vector(message);
  for (int i = 0; i < 4; ++i) pose.rotation.coeffs()[i] = message.read<double>();
  return pose;
}

void add_image(MessageWriter& message, const cv::Mat& image) {
  message.add(image.rows);
  message.add(image.cols);
  message.add(image.empty() ? 0 : image.type());  // a released one keeps its own
  const cv::Mat whole = image.isContinuous() ? image : image.clone();
  message.add_list(whole.data, whole.total() * whole.elemSize());
}

cv::Mat read_image(MessageReader& message) {
  const int rows = message.read<int>();
  const int columns = message.read<int>();
  const int type = message.read<int>();
  std::vector<std::uint8_t> bytes = message.read_list<std::uint8_t>();
  if (bytes.empty()) return {};
  return cv::Mat(rows, columns, type, bytes.data()).clone();
}

/// In the child: sends all frames.
void send_frames(int socket, const ChildDrive::Make& make) {
  try {
    const std::unique_ptr<FrameSource> source = make();
    while (const auto sample = source->next()) {
      send_message(socket, MessageKind::kProcess, pack_sample(*sample), wait_for_ever);
    }
    send_message(socket, MessageKind::kFinish, "", wait_for_ever);
  } catch (const std::exception& error) {
    try {
      send_message(socket, MessageKind::kRefused, error.what(), wait_for_ever);
    } catch (const Error&) {  // nobody listens any more
    }
  }
}

}  // namespace

std::string pack_sample(const Sample& sample) {
  MessageWriter message;
  message.add(sample.frame.index);
  message.add(sample.frame.stamp);
  message.add(static_cast<std::uint64_t>(sample.frame.images.size()));
  for (const cv::Mat& image : sample.frame.images) add_image(message, image);
  message.add_list(sample.frame.image_stamps.data(), sample.frame.image_stamps.size());
  message.add(static_cast<std::uint64_t>(sample.frame.imu.size()));
  for (const ImuSample& reading : sample.frame.imu) {
    message.add(reading.stamp);
    add_vector(message, reading.angular_velocity);
    add_vector(message, reading.specific_force);
  }
  message.add_list(sample.frame.wheels.data(), sample.frame.wheels.size());
  add_pose(message, sample.truth.T_world_body);
  message.add(static_cast<std::uint64_t>(sample.truth.path.size()));
  for (const StampedPose& pose : sample.truth.path) {
    message.add(pose.stamp);
    add_pose(message, pose.pose);
  }
  return message.content();
}

Sample unpack_sample(const std::string& content) {
  MessageReader message(content);
  Sample sample;
  sample.frame.index = message.read<std::int64_t>();
  sample.frame.stamp = message.read<Stamp>();
  sample.frame.images.resize(message.read<std::uint64_t>());
  for (cv::Mat& image : sample.frame.images) image = read_image(message);
  sample.frame.image_stamps = message.read_list<Stamp>();
  sample.frame.imu.resize(message.read<std::uint64_t>());
  for (ImuSample& reading : sample.frame.imu) {
    reading.stamp = message.read<Stamp>();
    reading.angular_velocity = read_vector(message);
    reading.specific_force = read_vector(message);
  }
  sample.frame.wheels = message.read_list<WheelSample>();
  sample.truth.T_world_body = read_pose(message);
  sample.truth.path.resize(message.read<std::uint64_t>());
  for (StampedPose& pose : sample.truth.path) {
    pose.stamp = message.read<Stamp>();
    pose.pose = read_pose(message);
  }
  return sample;
}

ChildDrive::ChildDrive(const Make& make, Rig rig) : rig_(std::move(rig)), parent_(getpid()) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    fail("a drive's process cannot be started: {}", std::strerror(errno));
  }
  std::fflush(nullptr);  // otherwise the child might write it again
  process_ = fork();
  if (process_ < 0) fail("a drive's process cannot be started: {}", std::strerror(errno));
  if (process_ == 0) {
    close(ends[0]);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() == parent_) send_frames(ends[1], make);
    _exit(0);
  }
  close(ends[1]);
  socket_ = ends[0];
}

ChildDrive::~ChildDrive() {
  close(socket_);
  if (getpid() != parent_) return;  // a further fork: not its child
  kill(process_, SIGTERM);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::optional<Sample> ChildDrive::next() {
  const auto message = receive_message(socket_, wait_for_ever);
  if (!message) fail("the process of a drive has ended by itself");
  if (message->kind == MessageKind::kFinish) return std::nullopt;
  if (message->kind != MessageKind::kProcess) fail("{}", message->content);
  return unpack_sample(message->content);
}

}  // namespace vinebench::harness
