// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/pose_sampling.h"

#include <array>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "core/util/random.h"

namespace vinebench::slam {
namespace {

constexpr double kNearest = 0.05;  // m before a camera

struct Match {
  std::size_t view = 0;
  std::size_t feature = 0;
  Eigen::Vector2d pixel;
  Eigen::Vector3d p_map;
  double limit = 0;  ///< px
};

std::vector<Match> gather(const Map& map, const FrameFeatures& frame, const EstimatorRig& rig,
                          double pixel_limit, const Associations& associations) {
  std::vector<Match> matches;
  for (std::size_t v = 0; v < associations.size(); ++v) {
    for (std::size_t f = 0; f < associations[v].size(); ++f) {
      if (associations[v][f] < 0) continue;
      const Keypoint& k = frame.views[v].features.keypoints[f];
      matches.push_back({v,
                         f,
                         {k.x, k.y},
                         map.landmark(associations[v][f]).position,
                         pixel_limit * rig.noise.level_scales[static_cast<std::size_t>(k.level)]});
    }
  }
  return matches;
}

/// The body's poses by which the matches of one view appear where they do.
std::vector<Pose> poses_of(const std::array<const Match*, 3>& three, const EstimatorRig& rig) {
  const StereoCameraModel& camera = rig.left_cameras[three[0]->view];
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> rays;
  for (const Match* match : three) {
    const Eigen::Vector3d ray = camera.lens.unproject(match->pixel);
    points.emplace_back(match->p_map.x(), match->p_map.y(), match->p_map.z());
    rays.emplace_back(ray.x(), ray.y());
  }
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> shifts;
  cv::solveP3P(points, rays, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), turns, shifts,
               cv::SOLVEPNP_AP3P);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const auto* r = turns[i].ptr<double>();
    const auto* t = shifts[i].ptr<double>();
    const Pose T_cam_map{exp_so3({r[0], r[1], r[2]}), {t[0], t[1], t[2]}};
    if (!T_cam_map.rotation.coeffs().allFinite() || !T_cam_map.translation.allFinite()) continue;
    poses.push_back((camera.T_cam_body.inverse() * T_cam_map).inverse());
  }
  return poses;
}

bool fits(const Match& match, const Pose& T_body_map, const EstimatorRig& rig) {
  const StereoCameraModel& camera = rig.left_cameras[match.view];
  const Eigen::Vector3d p_cam = camera.T_cam_body * (T_body_map * match.p_map);
  return p_cam.z() > kNearest && (camera.lens.project(p_cam) - match.pixel).norm() < match.limit;
}

int count_fitting(const std::vector<Match>& matches, const Pose& T_map_body,
                  const EstimatorRig& rig) {
  const Pose T_body_map = T_map_body.inverse();
  int count = 0;
  for (const Match& match : matches) count += fits(match, T_body_map, rig);
  return count;
}

/// Three different matches of one view; none where its draws give no such.
std::optional<std::array<const Match*, 3>> draw(const std::vector<Match>& matches,
                                                const RandomStream& random, std::uint64_t sample) {
  std::array<const Match*, 3> three{};
  for (std::uint64_t i = 0; i < three.size(); ++i) {
    const double at = random.uniform(3 * sample + i) * static_cast<double>(matches.size());
    three[i] = &matches[static_cast<std::size_t>(at)];
  }
  const bool one_view = three[0]->view == three[1]->view && three[0]->view == three[2]->view;
  const bool different = three[0] != three[1] && three[0] != three[2] && three[1] != three[2];
  return one_view && different ? std::optional(three) : std::nullopt;
}

}  // namespace

std::optional<Pose> sample_pose(const Map& map, const FrameFeatures& frame, const EstimatorRig& rig,
                                const PoseSampling& sampling, std::uint64_t seed,
                                Associations& associations) {
  const std::vector<Match> matches = gather(map, frame, rig, sampling.pixel_limit, associations);
  if (static_cast<int>(matches.size()) < sampling.min_inliers) return std::nullopt;
  const RandomStream random(seed, "pose-sampling", static_cast<std::uint64_t>(frame.index));
  std::optional<Pose> best;
  int most = sampling.min_inliers - 1;
  for (int sample = 0; sample < sampling.samples; ++sample) {
    const auto three = draw(matches, random, static_cast<std::uint64_t>(sample));
    if (!three) continue;
    for (const Pose& pose : poses_of(*three, rig)) {
      const int fitting = count_fitting(matches, pose, rig);
      if (fitting <= most) continue;
      most = fitting;
      best = pose;
    }
  }
  if (!best) return std::nullopt;
  const Pose T_body_map = best->inverse();
  for (const Match& match : matches) {
    if (!fits(match, T_body_map, rig)) associations[match.view][match.feature] = -1;
  }
  return best;
}

}  // namespace vinebench::slam
