// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/trajectory.h"
#include "harness/datasets/files/image_codec.h"
#include "harness/datasets/format/format_writer.h"
#include "harness/datasets/ros/messages/ros_output.h"
#include "harness/datasets/ros/ros_camera.h"
#include "slam/tags/tag_detector.h"

namespace vinebench::harness {

/// A bag of ROS: images and calibration of each camera, inertial and wheel readings, the
/// tags that the SLAM core's detector finds, the clock and the rig's transforms; and the truth, on
/// a separate topic and in a separate frame. docs/datasets.md has topics, types and frames.
class RosWriter : public FormatWriter {
 public:
  /// Raw images if `kind` is absent. Throws Error for WebP, which ROS does not support, and as
  /// ros_cameras() does.
  RosWriter(std::unique_ptr<RosOutput> bag, const RecordingNotes& notes, bool colour,
            std::optional<ImageKind> kind);

  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;
  void commit(const DatasetFrame& frame) override;
  void finish() override;

 private:
  FileTask image_task(const std::shared_ptr<const DatasetFrame>& frame, std::size_t camera);
  /// Writes the clock, and at the first time the rig.
  RosHeader header(Stamp stamp, const std::string& frame);
  void write_rig(Stamp stamp);
  void write_readings(const Frame& frame);
  void write_imu(const ImuSample& reading);
  void write_wheels(const WheelSample& reading);
  void write_truth(const StampedPose& now);
  void write_image(std::size_t camera, const cv::Mat& image, Stamp stamp);
  void write_tags(const Frame& frame);

  RecordingNotes notes_;
  Rig rig_;
  bool colour_;
  std::optional<ImageKind> kind_;
  std::vector<RosCamera> cameras_;
  std::vector<std::string> images_;  ///< of the current frame, by camera
  slam::TagDetector detector_;
  std::optional<StampedPose> before_;  ///< previous true pose
  std::int64_t clock_ = 0;             ///< last written time
  std::unique_ptr<RosOutput> bag_;
};

}  // namespace vinebench::harness
