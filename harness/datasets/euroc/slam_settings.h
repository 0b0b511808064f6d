// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/datasets/format/recording_notes.h"

namespace vinebench::harness {

struct SettingsFile {
  std::string name;
  std::string text;
};

/// Settings of other SLAM systems for an EuRoC recording: the first pair as their stereo camera
/// (cam0 and cam1 if the rig begins with it), the body as the inertial unit. ORB-SLAM3 (v1.0;
/// without distortion if the pair is rectified, and with it), Basalt, Kalibr's chains for OpenVINS,
/// stella_vslam. Throws Error for a rig without a pair.
std::vector<SettingsFile> slam_settings(const RecordingNotes& notes);

}  // namespace vinebench::harness
