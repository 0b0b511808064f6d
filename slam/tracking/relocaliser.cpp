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
constexpr double kStepNoise = 0.05;  // s

/// A camera with fewer matches says nothing for or against a pose.
constexpr int kMinViewMatches = 12;

constexpr double kSearchRadius = 8;  // px, around projections by the sampled pose

/// Of a hint: around projections by the adjusted pose, px; turned away by so much what matches is
/// chance, rad; and by how many standard deviations of that there must be more.
constexpr double kHintRadius = 4;
constexpr double kTurnedAway[] = {-0.12, -0.06, 0.06, 0.12};
constexpr double kHintDeviations = 3;

/// Frames that must agree on a hint, and as many more for each that contradicts.
constexpr int kFramesOfHints = 3;
constexpr int kFramesAgainst = 2;

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

/// Matches of each view within a few pixels of where they are to be.
std::vector<int> count_matches(const Map& map, const EstimatorRig& rig, const FrameFeatures& frame,
                               const std::vector<int>& landmarks, const Pose& T_map_body,
                               const RelocaliserOptions& options) {
  Associations associations = no_associations(frame);
  match_by_projection(map, landmarks, frame, T_map_body, rig,
                      {kHintRadius, options.max_hamming, options.second_best}, associations);
  std::vector<int> counts;
  for (const std::vector<int>& of_view : associations) {
    counts.push_back(static_cast<int>(of_view.size() -
                                      static_cast<std::size_t>(std::ranges::count(of_view, -1))));
  }
  return counts;
}

/// Whether every view that sees something has more matches there than chance gives it: than where
/// the body looks a few degrees aside.
bool is_hint(const Map& map, const EstimatorRig& rig, const FrameFeatures& frame,
             const std::vector<int>& landmarks, const Pose& T_map_body,
             const RelocaliserOptions& options) {
  std::vector<double> chance(frame.views.size(), 0);
  for (const double turn : kTurnedAway) {
    const Pose aside = T_map_body * Pose{exp_so3({0, 0, turn}), Eigen::Vector3d::Zero()};
    const std::vector<int> counts = count_matches(map, rig, frame, landmarks, aside, options);
    for (std::size_t v = 0; v < chance.size(); ++v) chance[v] += counts[v];
  }
  const std::vector<int> counts = count_matches(map, rig, frame, landmarks, T_map_body, options);
  for (std::size_t v = 0; v < chance.size(); ++v) {
    if (frame.views[v].features.size() == 0) continue;
    chance[v] /= static_cast<double>(std::size(kTurnedAway));
    if (counts[v] < chance[v] + kHintDeviations * std::sqrt(chance[v] + 1)) return false;
  }
  return true;
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
  if (motion.inliers < options.min_inliers) return std::nullopt;
  const bool is_sure = cameras_agree(motion, options.min_share);
  if (!is_sure &&
      !(options.unsure && is_hint(map, rig, frame, landmarks, motion.T_map_body, options))) {
    return std::nullopt;
  }
  return Relocation{motion.T_map_body, motion.inliers, is_sure, motion.information};
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

/// Lengthens the ways of what was found by the frame's, if that begins at the frame before.
void Relocaliser::follow(const FrameFeatures& frame) {
  std::erase_if(found_, [&](const Found& one) {
    const double dt = to_seconds(frame.stamp - one.stamp);
    return dt <= 0 || dt > options_.max_gap_seconds;
  });
  const double dt = to_seconds(frame.stamp - stamp_);
  const bool is_known = frame.wheels && std::abs(frame.wheels->seconds - dt) <= kStepNoise;
  for (Found& one : found_) {
    one.is_last = one.stamp == stamp_;
    if (!is_known) one.way.reset();
    if (one.way) one.way = *one.way * frame.wheels->T_before_now;
  }
}

bool Relocaliser::follows_at_once(const Found& before, const Relocation& now, Stamp stamp) const {
  const double dt = to_seconds(stamp - before.stamp);
  const Pose moved = before.T_map_body.inverse() * now.T_map_body;
  return before.is_last && moved.translation.norm() <= kFoundPoseNoise + options_.max_speed * dt &&
         angle_of(moved.rotation) <= kTurnNoise + options_.max_turn * dt;
}

bool Relocaliser::believes(const Relocation& now, Stamp stamp) const {
  int frames = 1;
  int against = 0;
  bool was_sure = false;
  for (const Found& one : found_) {
    if (follows_at_once(one, now, stamp)) was_sure = was_sure || one.is_sure;
    if (!one.way) continue;
    const Pose error = (one.T_map_body * *one.way).inverse() * now.T_map_body;
    const bool agrees =
        error.translation.norm() <= kFoundPoseNoise + kSlip * one.way->translation.norm() &&
        angle_of(error.rotation) <= kTurnNoise + kSlip * angle_of(one.way->rotation);
    ++(agrees ? frames : against);
    was_sure = was_sure || (agrees && one.is_sure);
  }
  return (now.is_sure && was_sure) || frames >= kFramesOfHints + kFramesAgainst * against;
}

std::optional<Pose> Relocaliser::find(const Map& map, const EstimatorRig& rig,
                                      const FrameFeatures& frame) {
  remember(resemblance(map, frame, options_.queries, options_.max_hamming), frame.stamp);
  follow(frame);
  stamp_ = frame.stamp;
  const std::vector<int> places = keyframes_alike(map, resemblance_, options_.candidates);
  const std::optional<Relocation> now = relocate_among(map, rig, frame, places, options_);
  if (!now) return std::nullopt;
  const bool believed = believes(*now, frame.stamp);
  found_.push_back({.T_map_body = now->T_map_body, .is_sure = now->is_sure, .stamp = frame.stamp});
  return believed ? std::optional(now->T_map_body) : std::nullopt;
}

}  // namespace vinebench::slam
