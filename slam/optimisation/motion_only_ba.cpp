// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/motion_only_ba.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "slam/factors/robust_loss.h"
#include "slam/frame/measurements.h"

namespace vinebench::slam {
namespace {

const RobustLoss kFar = RobustLoss::huber(std::sqrt(kChiSquared2));

struct Match {
  Match(std::size_t v, std::size_t f, const StereoCameraModel& camera, const PixelMeasurement& m,
        const Eigen::Vector3d& p)
      : view(v), feature(f), p_map(p), limit(chi_squared_limit(m)), error(camera, m) {}

  std::size_t view;
  std::size_t feature;
  Eigen::Vector3d p_map;
  double limit;
  Reprojection error;
  bool inlier = true;
};

using Matches = std::vector<Match>;

Matches gather(const Map& map, const FrameFeatures& frame, const EstimatorRig& rig,
               const Associations& associations) {
  Matches matches;
  for (std::size_t v = 0; v < associations.size(); ++v) {
    for (std::size_t f = 0; f < associations[v].size(); ++f) {
      if (associations[v][f] < 0) continue;
      PixelMeasurement m = measure(frame.views[v], static_cast<int>(f), rig.noise);
      m.velocity = frame.velocity;
      matches.emplace_back(v, f, rig.left_cameras[v], m, map.landmark(associations[v][f]).position);
    }
  }
  return matches;
}

/// Normal equations of the robust least squares about a pose.
struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();
};

NormalEquations linearise(const Matches& matches, const Pose& pose, const RobustLoss& loss) {
  NormalEquations sum;
  for (const Match& match : matches) {
    if (!match.inlier) continue;
    const Reprojection::Linearised at = match.error.linearise(pose, match.p_map);
    const double weight = loss.weight(at.residual.squaredNorm());
    sum.H += weight * at.by_pose.transpose() * at.by_pose;
    sum.g += weight * at.by_pose.transpose() * at.residual;
  }
  return sum;
}

double cost(const Matches& matches, const Pose& pose, const RobustLoss& loss) {
  double sum = 0;
  for (const Match& match : matches) {
    if (match.inlier) sum += loss.cost(match.error.residual(pose, match.p_map).squaredNorm());
  }
  return sum;
}

/// Levenberg-Marquardt on six numbers: small enough that a general solver's bookkeeping would cost
/// ten times the work itself.
Pose adjust(const Matches& matches, Pose pose, const RobustLoss& loss, Matrix6d& information) {
  constexpr int kMaxIterations = 12;
  constexpr double kEnough = 1e-6;  // relative decrease
  double damping = 1e-5;
  double now = cost(matches, pose, loss);
  for (int i = 0; i < kMaxIterations; ++i) {
    const NormalEquations normal = linearise(matches, pose, loss);
    information = normal.H;
    Matrix6d damped = normal.H;
    damped.diagonal() *= 1 + damping;
    damped.diagonal().array() += 1e-9;
    const Pose tried = pose * step_of(damped.ldlt().solve(-normal.g));
    const double then = cost(matches, tried, loss);
    if (then <= now) {
      pose = tried;
      const bool enough = now - then <= kEnough * now;
      now = then;
      damping = std::max(1e-9, damping / 10);
      if (enough) break;
    } else {
      damping = std::max(1e-4, damping * 10);
      if (damping > 1e6) break;
    }
  }
  return pose;
}

struct Classes {
  int inliers = 0;
  int changed = 0;  ///< of all, that were of the other class before
};

Classes classify(Matches& matches, const Pose& T_map_body) {
  Classes classes;
  for (Match& match : matches) {
    const bool inlier = match.error.chi_squared(T_map_body, match.p_map) <= match.limit;
    classes.inliers += inlier;
    classes.changed += inlier != match.inlier;
    match.inlier = inlier;
  }
  return classes;
}

/// Rounds of adjustment and removal of outliers: one that bears a far prediction, and then so many
/// that hardly any match changes its class, which takes more than three where many are wrong.
void adjust_in_rounds(Matches& matches, const RobustLoss& near, MotionEstimate& estimate) {
  constexpr int kLeastRounds = 4;
  constexpr int kMostRounds = 12;
  constexpr double kAtRest = 0.01;  // share of the matches
  for (int round = 0; round < kMostRounds; ++round) {
    const RobustLoss& loss = round == 0 ? kFar : near;
    estimate.T_map_body = adjust(matches, estimate.T_map_body, loss, estimate.information);
    const Classes classes = classify(matches, estimate.T_map_body);
    estimate.inliers = classes.inliers;
    if (classes.inliers < 6) break;
    const bool at_rest = classes.changed <= kAtRest * static_cast<double>(matches.size());
    if (at_rest && round + 1 >= kLeastRounds) break;
  }
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

  const RobustLoss near = residual_loss(rig.noise.loss);
  adjust_in_rounds(matches, near, estimate);
  count_views(matches, estimate);
  const std::vector<char> doubtful = doubtful_views(estimate, min_inlier_share);
  if (std::find(doubtful.begin(), doubtful.end(), 1) != doubtful.end()) {
    for (Match& match : matches) match.inlier &= !doubtful[match.view];
    estimate.T_map_body = adjust(matches, estimate.T_map_body, near, estimate.information);
    estimate.inliers = classify(matches, estimate.T_map_body).inliers;
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

}  // namespace vinebench::slam
