// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros/ros_writer.h"

#include <fmt/format.h>

#include <utility>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr const char* kWorld = "world";
// Not a parent of the body: base_link's pose is a SLAM system's output.
constexpr const char* kTruth = "ground_truth";

std::optional<ImageKind> checked(std::optional<ImageKind> kind) {
  if (kind == ImageKind::kWebp)
    fail("bag of ROS: --image webp: expected png or jpg, or raw images");
  return kind;
}

RosVector message(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

RosPose message(const Pose& T) {
  const Eigen::Quaterniond& q = T.rotation;
  return {message(T.translation), {q.x(), q.y(), q.z(), q.w()}};
}

double variance(const ImuNoise::Axes& axes, double rate_hz) {
  return axes.noise_density * axes.noise_density * rate_hz;
}

std::string raw_bytes(const cv::Mat& image) {
  const cv::Mat whole = image.isContinuous() ? image : image.clone();
  return {whole.ptr<char>(), whole.total() * whole.elemSize()};
}

}  // namespace

RosWriter::RosWriter(std::unique_ptr<RosOutput> bag, const RecordingNotes& notes, bool colour,
                     std::optional<ImageKind> kind)
    : notes_(notes),
      rig_(notes.rig.make()),
      colour_(colour),
      kind_(checked(kind)),
      cameras_(ros_cameras(rig_)),
      images_(cameras_.size()),
      detector_(notes.slam.tags, notes.tags),
      bag_(std::move(bag)) {
  if (!kind_) return;
  for (RosCamera& camera : cameras_) camera.images += "/compressed";  // image_transport's name
}

std::vector<FileTask> RosWriter::files(const std::shared_ptr<const DatasetFrame>& frame) {
  std::vector<FileTask> tasks;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!frame->frame.images[i].empty()) tasks.push_back(image_task(frame, i));
  }
  return tasks;
}

FileTask RosWriter::image_task(const std::shared_ptr<const DatasetFrame>& frame,
                               std::size_t camera) {
  const std::string coding =
      kind_ ? yaml_names(*kind_).at(static_cast<std::size_t>(*kind_)) : "raw";
  return {fmt::format("{} {} {}", colour_ ? "rgb" : "grey", coding, camera),
          {},
          [frame, camera, colour = colour_, kind = kind_] {
            const cv::Mat& taken = frame->frame.images[camera];
            const cv::Mat image = colour ? taken : to_grey(taken);
            return kind ? encode_image(image, *kind) : raw_bytes(image);
          },
          [this, camera](const std::string& bytes) { images_[camera] = bytes; }};
}

void RosWriter::commit(const DatasetFrame& written) {
  const Frame& frame = written.frame;
  write_readings(frame);
  if (written.truth.known) write_truth({frame.stamp, written.truth.T_world_body});
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!frame.images[i].empty()) write_image(i, frame.images[i], frame.image_stamp(i));
  }
  write_tags(frame);
  bag_->end_chunk();
}

void RosWriter::finish() {
  bag_->close();
}

RosHeader RosWriter::header(Stamp stamp, const std::string& frame) {
  const std::int64_t time = kRosStart + stamp;
  if (time > clock_) {
    const bool first = std::exchange(clock_, time) == 0;
    bag_->write_clock("/clock", time);
    if (first) write_rig(stamp);
  }
  return {time, frame};
}

void RosWriter::write_rig(Stamp stamp) {
  std::vector<RosTransform> mounts;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    mounts.push_back(
        {header(stamp, kRosBody), cameras_[i].frame, message(rig_.cameras[i].T_body_cam)});
  }
  bag_->write_latched("/tf_static", mounts);
}

/// Sorted by stamp; an inertial reading comes before a wheel reading of the same stamp.
void RosWriter::write_readings(const Frame& frame) {
  if (const auto first = std::exchange(notes_.first_reading, std::nullopt)) write_imu(*first);
  auto wheel = frame.wheels.begin();
  for (const ImuSample& reading : frame.imu) {
    for (; wheel != frame.wheels.end() && wheel->stamp < reading.stamp; ++wheel) {
      write_wheels(*wheel);
    }
    write_imu(reading);
  }
  for (; wheel != frame.wheels.end(); ++wheel) write_wheels(*wheel);
}

void RosWriter::write_imu(const ImuSample& reading) {
  bag_->write("/imu", RosImu{header(reading.stamp, kRosBody), message(reading.angular_velocity),
                             message(reading.specific_force),
                             variance(notes_.imu.gyroscope, notes_.imu_rate_hz),
                             variance(notes_.imu.accelerometer, notes_.imu_rate_hz)});
}

void RosWriter::write_wheels(const WheelSample& reading) {
  bag_->write("/joint_states", RosJointState{header(reading.stamp, ""),
                                             {"front_left_wheel", "front_right_wheel",
                                              "rear_left_wheel", "rear_right_wheel"},
                                             {reading.angle.begin(), reading.angle.end()},
                                             {reading.velocity.begin(), reading.velocity.end()}});
}

/// Velocities are means since the previous frame.
void RosWriter::write_truth(const StampedPose& now) {
  const RosHeader at = header(now.stamp, kWorld);
  RosOdometry odometry{at, kTruth, message(now.pose), {}, {}};
  if (before_) {
    const double seconds = to_seconds(now.stamp - before_->stamp);
    const Pose step = now.pose.inverse() * before_->pose;
    odometry.velocity = message(Eigen::Vector3d(-step.translation / seconds));
    odometry.angular_velocity = message(Eigen::Vector3d(-log_so3(step.rotation) / seconds));
  }
  before_ = now;
  bag_->write_transforms("/tf", {{at, kTruth, message(now.pose)}});
  bag_->write("/ground_truth", odometry);
}

void RosWriter::write_image(std::size_t camera, const cv::Mat& image, Stamp stamp) {
  RosCamera& told = cameras_[camera];
  const RosHeader at = header(stamp, told.frame);
  std::string bytes = std::move(images_[camera]);
  if (kind_) {
    bag_->write(told.images,
                RosCompressedImage{at, kind_ == ImageKind::kJpeg ? "jpeg" : "png", bytes});
  } else {
    const bool rgb = colour_ && image.channels() == 3;
    bag_->write(told.images, RosImage{at, image.cols, image.rows, rgb ? "rgb8" : "mono8", bytes});
  }
  told.calibration.header = at;
  bag_->write(told.info, told.calibration);
}

/// Ambiguous poses are left out, because the message cannot mark them.
void RosWriter::write_tags(const Frame& frame) {
  for (const int index : rig_.tag_cameras) {
    const auto camera = static_cast<std::size_t>(index);
    const cv::Mat& image = frame.images[camera];
    if (image.empty()) continue;
    std::vector<RosTransform> tags;
    for (const TagSighting& tag :
         detector_.detect(to_grey(image), rig_.cameras[camera].model, index)) {
      if (tag.ambiguous) continue;
      tags.push_back({header(frame.stamp, cameras_[camera].frame),
                      fmt::format("{}_{}", tag.family, tag.id), message(tag.T_cam_tag)});
    }
    bag_->write_transforms("/tags", tags);
  }
}

}  // namespace vinebench::harness
