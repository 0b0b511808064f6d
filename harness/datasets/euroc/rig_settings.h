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

// Calibrations of any number of cameras; the body is the inertial unit.

/// Kalibr's chain of cameras: cam0, cam1, ... in this order.
std::string kalibr_chain(const std::vector<RigCamera>& cameras);

/// Kalibr's inertial unit, imu0.
std::string kalibr_imu(const RecordingNotes& notes);

/// Basalt's calibration.
std::string basalt_settings(const std::vector<RigCamera>& cameras, const RecordingNotes& notes);

/// cuVSLAM's EDEX: the cameras of all stereo pairs, pair after pair, in the frame of the first one.
/// Its axes are OpenGL's (x right, y up, z back), of frame and cameras, as cuVSLAM's own examples
/// read them.
std::string edex_settings(const Rig& rig);

/// Files of all of a rig's cameras: Kalibr's chain, Basalt's calibration, OKVIS2's configuration,
/// OpenVINS' configuration with a chain of the cameras in its own order, pairs first, and EDEX.
std::vector<SettingsFile> rig_settings(const Rig& rig, const RecordingNotes& notes);

}  // namespace vinebench::harness
