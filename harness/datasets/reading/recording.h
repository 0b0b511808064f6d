// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/slam_system.h"
#include "core/truth/frame_source.h"

namespace vinebench::harness {

/// The images of a recording that are in no files of their own, by names that its reader gave
/// them.
class ImageStore {
 public:
  virtual ~ImageStore() = default;
  /// As read_grey() of files; on any thread, concurrently.
  virtual cv::Mat read_grey(const std::filesystem::path& image) const = 0;
};

/// The images of one instant, by name.
struct RecordedFrame {
  Stamp stamp = 0;
  std::vector<std::filesystem::path> images;  ///< of each camera of the rig; empty if it has none
  std::vector<SourceEvent> events;            ///< faults found during association
  std::vector<Stamp> image_stamps{};          ///< as Frame::image_stamps
};

/// The index of a recorded data set, as its format's reader found it; the images themselves stay on
/// the disk.
struct Recording {
  std::string name;
  std::string format;  ///< human-readable: "EuRoC/ASL", "KITTI odometry"
  Rig rig;
  /// ns, of each camera: how much later its images are taken, by the clock of the inertial unit,
  /// than they are stamped; empty for none. open_recording() ends with delay_images().
  std::vector<Stamp> image_delays{};
  Pose T_body_left;                           ///< the camera of a ground truth in KITTI format
  std::vector<RecordedFrame> frames;          ///< in ascending order of their stamps
  std::shared_ptr<const ImageStore> store{};  ///< of the images; null if they are files
  std::vector<ImuSample> imu;                 ///< likewise, in the body frame
  std::vector<WheelSample> wheels;            ///< likewise
  Trajectory truth;                           ///< T_world_body; empty if there is none
  std::vector<RegisteredTag> tags;
  std::filesystem::path settings;  ///< SlamConfig of the run that it was recorded from, if any
};

/// Files that replace those of the recording.
struct RecordingOptions {
  std::filesystem::path rig;          ///< for set_rig(); camera i is the recording's camera i
  std::filesystem::path groundtruth;  ///< TUM, KITTI (12 numbers a line) or EuRoC (csv)
  std::vector<std::string> topics{};  ///< of a bag's images, in the order of cameras
};

/// Gives a recording with that many cameras the rig of a file, ours or a camera chain of Kalibr,
/// which may use fewer. A chain has delays of images and no rate. Throws Error.
void set_rig(const std::filesystem::path& file, std::size_t cameras, Recording& recording);

/// Stamps frames and images as their delays say, which are none then.
void delay_images(Recording& recording);

}  // namespace vinebench::harness
