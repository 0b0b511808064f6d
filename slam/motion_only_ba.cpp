// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/motion_only_ba.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace vinebench {
namespace {

struct Match {
  Match(std::size_t v, std::size_t f, const EyeModel& eye, const PixelMeasurement& m,
        const Eigen::Vector3d& p)
      : view(v), feature(f), p_map(p), limit(chi_squared_limit(m)), error(eye, m, p) {}

  std::size_t view;
  std::size_t feature;
  Eigen::Vector3d p_map;
  double limit;
  ReprojectionError error;
  bool inlier = true;
};

/// A deque: cost functions stay where they are.
using Matches = std::deque<Match>;

Matches gather(const Map& map, const FrameFeatures& frame, const EstimatorRig& rig,
               const Associations& associations) {
  Matches matches;
  for (std::size_t v = 0; v < associations.size(); ++v) {
    for (std::size_t f = 0; f < associations[v].size(); ++f) {
      if (associations[v][f] < 0) continue;
      const PixelMeasurement m = rig.measurement(frame.views[v], static_cast<int>(f));
      matches.emplace_back(v, f, rig.eyes[v], m, map.landmark(associations[v][f]).position);
    }
  }
  return matches;
}

Pose adjust(Matches& matches, const Pose& start, ceres::LossFunction& loss) {
  PoseBlock block = to_block(start);
  PoseManifold manifold;
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.disable_all_safety_checks = true;
  ceres::Problem problem(ownership);
  problem.AddParameterBlock(block.data(), 7, &manifold);
  for (Match& match : matches) {
    if (match.inlier) problem.AddResidualBlock(&match.error, &loss, block.data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 10;
  options.function_tolerance = 1e-5;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return from_block(block.data());
}

int classify(Matches& matches, const Pose& T_map_body) {
  int inliers = 0;
  for (Match& match : matches) {
    match.inlier = match.error.chi_squared(T_map_body, match.p_map) <= match.limit;
    inliers += match.inlier;
  }
  return inliers;
}

void count_views(const Matches& matches, MotionEstimate& estimate) {
  std::fill(estimate.inliers_per_view.begin(), estimate.inliers_per_view.end(), 0);
  for (const Match& match : matches) estimate.inliers_per_view[match.view] += match.inlier;
}

/// Views in poor agreement with the pose while another is in good agreement.
std::vector<char> doubtful_views(const MotionEstimate& estimate, double min_share) {
  const std::size_t n = estimate.matches_per_view.size();
  std::vector<char> doubtful(n, 0);
  bool any_good = false;
  for (std::size_t v = 0; v < n; ++v) {
    const bool poor = estimate.inliers_per_view[v] < min_share * estimate.matches_per_view[v];
    doubtful[v] = poor;
    any_good |= !poor && estimate.inliers_per_view[v] >= 20;
  }
  if (!any_good) std::fill(doubtful.begin(), doubtful.end(), 0);
  return doubtful;
}

}  // namespace

MotionEstimate estimate_motion(const Map& map, const FrameFeatures& frame, const Pose& prediction,
                               const EstimatorRig& rig, double min_inlier_share,
                               Associations& associations) {
  Matches matches = gather(map, frame, rig, associations);
  MotionEstimate estimate;
  estimate.T_map_body = prediction;
  estimate.matches_per_view.assign(associations.size(), 0);
  estimate.inliers_per_view.assign(associations.size(), 0);
  for (const Match& match : matches) ++estimate.matches_per_view[match.view];
  if (matches.size() < 6) {
    for (const Match& match : matches) associations[match.view][match.feature] = -1;
    return estimate;
  }

  ceres::HuberLoss far(std::sqrt(kChiSquared2));
  ceres::CauchyLoss near(kCauchyScale);
  for (ceres::LossFunction* loss :
       std::initializer_list<ceres::LossFunction*>{&far, &near, &near}) {
    estimate.T_map_body = adjust(matches, estimate.T_map_body, *loss);
    estimate.inliers = classify(matches, estimate.T_map_body);
    if (estimate.inliers < 6) break;
  }
  count_views(matches, estimate);
  const std::vector<char> doubtful = doubtful_views(estimate, min_inlier_share);
  if (std::find(doubtful.begin(), doubtful.end(), 1) != doubtful.end()) {
    for (Match& match : matches) match.inlier &= !doubtful[match.view];
    estimate.T_map_body = adjust(matches, estimate.T_map_body, near);
    estimate.inliers = classify(matches, estimate.T_map_body);
    for (Match& match : matches) {
      estimate.inliers -= match.inlier && doubtful[match.view];
      match.inlier &= !doubtful[match.view];
    }
    count_views(matches, estimate);
  }
  for (const Match& match : matches) {
    if (!match.inlier) associations[match.view][match.feature] = -1;
  }
  return estimate;
}

}  // namespace vinebench
