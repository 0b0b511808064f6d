// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/relocaliser.h"

#include <algorithm>
#include <cmath>
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

/// Wheels may slip: of the way between two frames.
constexpr double kSlip = 0.1;

/// What the wheels' step may have more or less of time than the frames.
constexpr double kStepNoise = 0.02;  // s

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
  const std::vector<double> alike = resemblance(map, frame, options.queries, options.max_hamming);
  return relocate_among(map, rig, frame, keyframes_alike(map, alike, options.candidates), options);
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

void Relocaliser::remember(const std::vector<double>& resemblance, Stamp stamp) {
  const double fading = std::exp(-to_seconds(stamp - stamp_) / options_.memory);
  resemblance_.resize(resemblance.size(), 0);
  for (std::size_t k = 0; k < resemblance.size(); ++k) {
    resemblance_[k] = fading * resemblance_[k] + resemblance[k];
  }
}

/// Lengthens the candidate's way by the frame's, if that begins at the frame before.
void Relocaliser::follow(const FrameFeatures& frame) {
  if (!candidate_) return;
  const double dt = to_seconds(frame.stamp - stamp_);
  if (!frame.wheels || std::abs(frame.wheels->seconds - dt) > kStepNoise) candidate_->way.reset();
  if (candidate_->way) candidate_->way = *candidate_->way * frame.wheels->T_before_now;
}

bool Relocaliser::agree(const Relocation& now, Stamp stamp) const {
  if (!candidate_) return false;
  const double dt = to_seconds(stamp - candidate_->stamp);
  if (dt <= 0 || dt > options_.max_gap_seconds) return false;
  const Pose moved = candidate_->T_map_body.inverse() * now.T_map_body;
  if (candidate_->frames == 0) {
    return moved.translation.norm() <= kFoundPoseNoise + options_.max_speed * dt &&
           angle_of(moved.rotation) <= kTurnNoise + options_.max_turn * dt;
  }
  if (!candidate_->way) return false;
  const Pose& way = *candidate_->way;
  return (moved.translation - way.translation).norm() <=
             kFoundPoseNoise + kSlip * way.translation.norm() &&
         angle_of(way.rotation.conjugate() * moved.rotation) <=
             kTurnNoise + kSlip * angle_of(way.rotation);
}

std::optional<Pose> Relocaliser::find(const Map& map, const EstimatorRig& rig,
                                      const FrameFeatures& frame) {
  remember(resemblance(map, frame, options_.queries, options_.max_hamming), frame.stamp);
  follow(frame);
  stamp_ = frame.stamp;
  const std::vector<int> places = keyframes_alike(map, resemblance_, options_.candidates);
  const std::optional<Relocation> now = relocate_among(map, rig, frame, places, options_);
  if (!now) {
    if (candidate_) ++candidate_->frames;
    return std::nullopt;
  }
  const bool believed = agree(*now, frame.stamp);
  candidate_ = Candidate{.T_map_body = now->T_map_body, .stamp = frame.stamp};
  return believed ? std::optional(now->T_map_body) : std::nullopt;
}

}  // namespace vinebench::slam
