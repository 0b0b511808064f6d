// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "slam/camera/tag_cameras.h"
#include "slam/tags/tag_sightings.h"

namespace vinebench::slam {

/// What sightings of tags say of poses, and how surely. A covariance of a pose is that of the steps
/// of step_of about it (m and rad in the pose's own axes).

/// A sighting of a tag whose place in some frame is known.
struct PlacedSighting {
  Pose T_ref_tag;
  double size = 0;  ///< m
  const TagSighting* sighting = nullptr;
};

/// Covariance of T_body_tag, from that of the corners: far away and aslant it is large.
Matrix6d tag_covariance(const TagSighting& sighting, double size, const TagCameras& cameras,
                        double systematic);

/// 99.9 % of the chi-square distribution with six degrees of freedom: what a pose is at most off
/// by.
inline constexpr double kPoseLimit = 22.46;

/// Squared distance of two poses in standard deviations of their difference: chi-square with six
/// degrees of freedom. `covariance` is about `a`.
double pose_chi_squared(const Pose& a, const Pose& b, const Matrix6d& covariance);

/// T_ref_body by all corners of those sightings that agree with each other. Nothing where no more
/// than half of them do: one of two that contradict each other is wrong, but which?
std::optional<Pose> locate_by_tags(const std::vector<PlacedSighting>& seen,
                                   const TagCameras& cameras, double systematic);

}  // namespace vinebench::slam
