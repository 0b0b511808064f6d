// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/config/config_field.h"

namespace vinebench::harness {

/// Minimum number of seeds for a median.
inline constexpr std::size_t kSeedsForMedian = 3;

/// The expectations of a scenario. Absent ones are not checked.
struct Expectations {
  /// Occluders of any class cover some cameras almost completely while the rover moves, and
  /// tracking continues.
  struct Blind {
    std::vector<std::string> cameras;    ///< names of the rig
    double box_share = 0.8;              ///< of each one's pixels, covered by occluders
    double seconds = 3;                  ///< s at least, continuously, in motion
    std::optional<double> inliers_drop;  ///< minimum share by which their inliers drop, 0 to 1
    template <class Archive>
    void serialize(Archive& archive) {
      archive("cameras", cameras);
      archive("box_share", box_share, Range::between(0.01, 1));
      archive("seconds", seconds, Range::positive());
      archive("inliers_drop", inliers_drop, Range::between(0, 1));
      archive.require(!cameras.empty(), "cameras", "expected at least one camera of the rig");
    }
  };
  /// Of the median over the runs of a set with at least kSeedsForMedian seeds.
  struct Median {
    std::optional<double> ate_rmse_max;         ///< m, SE(3)-aligned
    std::optional<double> ate_origin_rmse_max;  ///< m, aligned by the first pose
    template <class Archive>
    void serialize(Archive& archive) {
      archive("ate_rmse_max", ate_rmse_max, Range::positive());
      archive("ate_origin_rmse_max", ate_origin_rmse_max, Range::positive());
    }
  };
  std::optional<double> coverage_min;                ///< share of frames with a pose, 0 to 1
  std::optional<int> losses_max;                     ///< number of tracking losses
  std::optional<double> ate_rmse_max;                ///< m, SE(3)-aligned
  std::optional<double> ate_origin_rmse_max;         ///< m, aligned by the first pose
  std::optional<double> ate_world_rmse_max;          ///< m, in the world, not aligned
  std::optional<double> ate_world_live_rmse_max;     ///< m, likewise, of what was told live
  std::optional<double> rpe_trans_percent_max;       ///< relative error of the translation over 1 m
  std::optional<double> worst_frame_max;             ///< m, aligned by the first pose
  std::optional<double> drift_max;                   ///< m, before the first loop closure
  std::optional<double> heading_rmse_max_deg;        ///< aligned by the first pose
  std::optional<double> heading_error_max_deg;       ///< likewise, of any frame
  std::optional<double> tilt_rmse_max_deg;           ///< aligned by the first pose
  std::optional<double> tilt_error_max_deg;          ///< likewise, of any frame
  std::optional<double> heading_world_rmse_max_deg;  ///< in the world, not aligned
  std::optional<double> tilt_world_rmse_max_deg;     ///< likewise
  std::optional<double> nees_mean_min;  ///< normalised estimation error squared; 6 is consistent
  std::optional<double> nees_mean_max;  ///< likewise
  std::optional<double> end_error_max;  ///< m, from the route's end to the true position
  std::optional<int> loop_closures_correct_min;  ///< that agree with the truth
  std::optional<int> loop_closures_wrong_max;    ///< that do not
  std::optional<int> loop_closures_missed_max;   ///< returns to a tag without a closure
  std::optional<Blind> blind;
  std::optional<Median> median;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("coverage_min", coverage_min, Range::between(0, 1));
    archive("losses_max", losses_max, Range::non_negative());
    archive("ate_rmse_max", ate_rmse_max, Range::positive());
    archive("ate_origin_rmse_max", ate_origin_rmse_max, Range::positive());
    archive("ate_world_rmse_max", ate_world_rmse_max, Range::positive());
    archive("ate_world_live_rmse_max", ate_world_live_rmse_max, Range::positive());
    archive("rpe_trans_percent_max", rpe_trans_percent_max, Range::positive());
    archive("worst_frame_max", worst_frame_max, Range::positive());
    archive("drift_max", drift_max, Range::positive());
    archive("heading_rmse_max_deg", heading_rmse_max_deg, Range::positive());
    archive("heading_error_max_deg", heading_error_max_deg, Range::positive());
    archive("tilt_rmse_max_deg", tilt_rmse_max_deg, Range::positive());
    archive("tilt_error_max_deg", tilt_error_max_deg, Range::positive());
    archive("heading_world_rmse_max_deg", heading_world_rmse_max_deg, Range::positive());
    archive("tilt_world_rmse_max_deg", tilt_world_rmse_max_deg, Range::positive());
    archive("nees_mean_min", nees_mean_min, Range::non_negative());
    archive("nees_mean_max", nees_mean_max, Range::positive());
    archive("end_error_max", end_error_max, Range::positive());
    archive("loop_closures_correct_min", loop_closures_correct_min, Range::non_negative());
    archive("loop_closures_wrong_max", loop_closures_wrong_max, Range::non_negative());
    archive("loop_closures_missed_max", loop_closures_missed_max, Range::non_negative());
    archive("blind", blind);
    archive("median", median);
  }
};

}  // namespace vinebench::harness
