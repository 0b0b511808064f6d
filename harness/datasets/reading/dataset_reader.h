// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/slam_system.h"
#include "core/truth/frame_source.h"
#include "slam/slam.h"

namespace vinebench::harness {

/// The images of one instant, by name.
struct RecordedFrame {
  Stamp stamp = 0;
  std::vector<std::filesystem::path>
      images;                       ///< of each camera of the rig; empty where it has none
  std::vector<SourceEvent> events;  ///< faults that were found when it was put together
};

/// A recorded data set as its reader found it; the images themselves stay on the disk.
struct Recording {
  std::string name;
  std::string format;  ///< for people: "EuRoC/ASL", "KITTI odometry"
  Rig rig;
  Pose T_body_left;                   ///< the camera whose poses a ground truth in KITTI's form has
  std::vector<RecordedFrame> frames;  ///< in ascending order of their stamps
  std::vector<ImuSample> imu;         ///< likewise, in the body frame
  std::vector<WheelSample> wheels;    ///< likewise
  Trajectory truth;                   ///< T_world_body; empty where there is none
  std::vector<RegisteredTag> tags;
  std::filesystem::path settings;  ///< SlamConfig of the run that it was recorded from, if any
};

/// What a user may put in the place of the recording's own.
struct RecordingOptions {
  std::filesystem::path rig;          ///< RigConfig, camera i is the recording's camera i
  std::filesystem::path groundtruth;  ///< TUM, KITTI (12 numbers a line) or EuRoC (csv)
};

/// Reads the index of a recording, whose format it recognises by its folders: EuRoC/ASL or KITTI
/// odometry, or a data set of ours that has one of them. Faults of single frames become events of
/// theirs; a calibration that cannot be used, a folder without images and images of another
/// size than the calibration's throw Error.
Recording open_recording(const std::filesystem::path& folder, const RecordingOptions& options = {});

/// Gives a recording frame by frame, the cameras' images in grey. An image that is not there,
/// cannot be read or has a wrong size is empty, and an event. The truth at a frame is interpolated
/// between its neighbours in time where they are at most a quarter of a second apart.
std::unique_ptr<FrameSource> play(Recording recording, WorkerPool& pool);

/// The pose at that time: of the trajectory's nearest pose within a microsecond, else between its
/// neighbours. Nothing before the first, after the last, and in gaps longer than `max_gap`.
std::optional<Pose> pose_at(const Trajectory& trajectory, Stamp stamp, Stamp max_gap);

}  // namespace vinebench::harness
