// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "harness/datasets/euroc/rig_settings.h"
#include "harness/datasets/format/recording_notes.h"

namespace vinebench::harness {

/// Settings of other SLAM systems for an EuRoC recording: the first pair as their stereo camera
/// (cam0 and cam1 if the rig begins with it), the body as the inertial unit. ORB-SLAM3 (v1.0;
/// without distortion if the pair is rectified, and with it), Basalt, Kalibr's chains,
/// stella_vslam; and those of all cameras (rig_settings.h). Throws Error for a rig without a pair.
std::vector<SettingsFile> slam_settings(const RecordingNotes& notes);

}  // namespace vinebench::harness
