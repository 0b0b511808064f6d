// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/relocaliser.h"

#include <algorithm>
#include <numbers>

#include "slam/matching/appearance_matcher.h"
#include "slam/matching/projection_matcher.h"
#include "slam/optimisation/motion_only_ba.h"
#include "slam/tracking/pose_sampling.h"

namespace vinebench::slam {
namespace {

/// Poses nearer than this are one place.
constexpr double kSamePlace = 0.5;                           // m
constexpr double kSameView = 20.0 * std::numbers::pi / 180;  // rad

/// What two frames' poses may differ by for their noise alone.
constexpr double kFoundPoseNoise = 0.05;                     // m
constexpr double kTurnNoise = 2.0 * std::numbers::pi / 180;  // rad

/// A camera with fewer matches says nothing for or against a pose.
constexpr int kMinViewMatches = 12;

constexpr double kSearchRadius = 8;  // px, around projections by the sampled pose

bool same_place(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm() < kSamePlace &&
         angle_of(a.rotation.conjugate() * b.rotation) < kSameView;
}

/// Whether the matches of all cameras together, and of each that has some, mostly fit.
bool cameras_agree(const MotionEstimate& motion, double min_share) {
  int matches = 0;
  for (std::size_t v = 0; v < motion.matches_per_view.size(); ++v) {
    const int of_view = motion.matches_per_view[v];
    if (of_view >= kMinViewMatches && motion.inliers_per_view[v] < min_share * of_view) {
      return false;
    }
    matches += of_view;
  }
  return motion.inliers >= min_share * matches;
}

/// Adjusts a sampled pose, looks for more landmarks with it and judges what comes out.
std::optional<Relocation> confirm(const Map& map, const EstimatorRig& rig,
                                  const FrameFeatures& frame, const std::vector<int>& landmarks,
                                  const Pose& sampled, Associations associations,
                                  const RelocaliserOptions& options) {
  // No view is to be passed over as blind here: all that see something must agree.
  MotionEstimate motion = estimate_motion(map, frame, sampled, rig, 0, associations);
  if (motion.inliers < options.min_consensus) return std::nullopt;
  match_by_projection(map, landmarks, frame, motion.T_map_body, rig,
                      {kSearchRadius, options.max_hamming, options.second_best}, associations);
  motion = estimate_motion(map, frame, motion.T_map_body, rig, 0, associations);
  if (motion.inliers < options.min_inliers || !cameras_agree(motion, options.min_share)) {
    return std::nullopt;
  }
  return Relocation{motion.T_map_body, motion.inliers, motion.information};
}

std::optional<Relocation> relocate_at(int keyframe, const Map& map, const EstimatorRig& rig,
                                      const FrameFeatures& frame,
                                      const RelocaliserOptions& options) {
  const std::vector<int> landmarks = landmarks_around(map, keyframe);
  Associations associations =
      match_by_appearance(map, landmarks, frame, options.max_hamming, options.second_best);
  const PoseSampling sampling{options.samples, options.pixel_limit, options.min_consensus};
  const std::optional<Pose> sampled =
      sample_pose(map, frame, rig, sampling, static_cast<std::uint64_t>(keyframe), associations);
  if (!sampled) return std::nullopt;
  return confirm(map, rig, frame, landmarks, *sampled, std::move(associations), options);
}

}  // namespace

std::optional<Relocation> relocate(const Map& map, const EstimatorRig& rig,
                                   const FrameFeatures& frame, const RelocaliserOptions& options) {
  return relocate_among(
      map, rig, frame,
      keyframes_alike(map, frame, options.queries, options.max_hamming, options.candidates),
      options);
}

std::optional<Relocation> relocate_among(const Map& map, const EstimatorRig& rig,
                                         const FrameFeatures& frame,
                                         const std::vector<int>& keyframes,
                                         const RelocaliserOptions& options) {
  std::optional<Relocation> best;
  int rival = 0;
  for (const int keyframe : keyframes) {
    const std::optional<Relocation> found = relocate_at(keyframe, map, rig, frame, options);
    if (!found) continue;
    const bool better = !best || found->inliers > best->inliers;
    if (best && !same_place(best->T_map_body, found->T_map_body)) {
      rival = std::max(rival, std::min(best->inliers, found->inliers));
    }
    if (better) best = found;
  }
  if (best && rival >= options.max_rival * best->inliers) return std::nullopt;
  return best;
}

bool Relocaliser::agree(const Relocation& now, Stamp stamp) const {
  const double dt = to_seconds(stamp - stamp_);
  if (!before_ || dt <= 0 || dt > options_.max_gap_seconds) return false;
  const Pose moved = before_->T_map_body.inverse() * now.T_map_body;
  return moved.translation.norm() <= kFoundPoseNoise + options_.max_speed * dt &&
         angle_of(moved.rotation) <= kTurnNoise + options_.max_turn * dt;
}

std::optional<Pose> Relocaliser::find(const Map& map, const EstimatorRig& rig,
                                      const FrameFeatures& frame) {
  const std::optional<Relocation> now = relocate(map, rig, frame, options_);
  const bool believed = now && agree(*now, frame.stamp);
  before_ = now;
  stamp_ = frame.stamp;
  return believed ? std::optional(now->T_map_body) : std::nullopt;
}

}  // namespace vinebench::slam
