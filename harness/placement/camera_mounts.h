// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "harness/placement/planned_drive.h"

namespace vinebench::harness {

/// How a camera could be mounted, and what it would see of the world's tags along a drive.
struct CameraMount {
  Eigen::Vector3d position{Eigen::Vector3d::Zero()};  ///< m, in the body frame
  Eigen::Vector3d rpy_deg{Eigen::Vector3d::Zero()};   ///< as in a rig's file
  std::size_t tags = 0;                               ///< that it sees at least once
  std::size_t poses = 0;                              ///< from which it sees one at least
  double error = 0;  ///< m, predicted, of kPlannedShare of the poses
};

/// Directions and heights that are tried.
struct MountGrid {
  double yaw_step_deg = 15;
  std::vector<double> pitches_deg{-15, 0, 15};  ///< positive is down
  std::vector<double> raises{-0.2, 0, 0.2};     ///< m, against where it is
};

/// As the rig has it. Throws Error, with the nearest name, if it has no such camera.
CameraMount current_mount(const RigConfig& rig, const std::string& camera);

/// Fills in what a camera so mounted sees, beside the rig's other cameras for tags.
void rate_mount(CameraMount& mount, const std::string& camera, const PlannedDrive& drive);

/// All of the grid around the current mount, at least 0.1 m above the ground, rated, the one with
/// the least predicted error first; of equals the one that sees tags from more poses.
std::vector<CameraMount> rate_mounts(const CameraMount& current, const std::string& camera,
                                     const PlannedDrive& drive, const MountGrid& grid);

/// The rig with its camera mounted so.
RigConfig with_mount(RigConfig rig, const std::string& camera, const CameraMount& mount);

/// All of them as CSV.
std::string mounts_csv(const std::vector<CameraMount>& mounts);

}  // namespace vinebench::harness
