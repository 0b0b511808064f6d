// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/matching/patch_follower.h"

#include <algorithm>
#include <cmath>

#include "slam/frame/measurements.h"
#include "slam/matching/landmark_view.h"
#include "slam/matching/patch_projector.h"
#include "slam/patches/patch_alignment.h"

namespace vinebench::slam {
namespace {

constexpr int kCell = 48;  // px; of the image's cells that share the landmarks

struct Candidate {
  int id;
  int keyframes;  ///< that saw it
  Eigen::Vector2d pixel;
  double depth;  ///< m
};

/// How many landmarks each cell of the image holds.
class Cells {
 public:
  Cells(const PinholeCamera& lens, int capacity)
      : columns_(lens.width / kCell + 1),
        counts_(static_cast<std::size_t>(columns_ * (lens.height / kCell + 1)), 0),
        capacity_(std::max(1, capacity / static_cast<int>(counts_.size()))) {}
  void add(double x, double y) { ++at(x, y); }
  bool full(double x, double y) { return at(x, y) >= capacity_; }

 private:
  int& at(double x, double y) {
    const int column = std::clamp(static_cast<int>(x) / kCell, 0, columns_ - 1);
    const int row =
        std::clamp(static_cast<int>(y) / kCell, 0, static_cast<int>(counts_.size()) / columns_ - 1);
    return counts_[static_cast<std::size_t>(row * columns_ + column)];
  }
  int columns_;
  std::vector<int> counts_;
  int capacity_;
};

class Follower {
 public:
  Follower(const Map& map, const Pose& T_map_body, const EstimatorRig& rig,
           const FollowSettings& settings, FrameFeatures& frame, int view)
      : map_(map),
        T_body_map_(view_pose(frame, static_cast<std::size_t>(view), T_map_body, rig).inverse()),
        rig_(rig),
        settings_(settings),
        frame_(frame),
        v_(view),
        projector_(map, view_poses(frame, T_map_body, rig), rig) {}

  void follow(const std::vector<int>& landmarks, std::vector<int>& associations) {
    const std::vector<Candidate> wanted = candidates(landmarks, associations);
    Cells cells(lens(), settings_.refinement.follow);
    for (std::size_t f = 0; f < associations.size(); ++f) {
      const Keypoint& keypoint = view().features.keypoints[f];
      if (associations[f] >= 0) cells.add(keypoint.x, keypoint.y);
    }
    for (const Candidate& candidate : wanted) {
      if (cells.full(candidate.pixel.x(), candidate.pixel.y())) continue;
      if (!find(candidate)) continue;
      associations.push_back(candidate.id);
      cells.add(candidate.pixel.x(), candidate.pixel.y());
    }
  }

 private:
  StereoView& view() { return frame_.views[static_cast<std::size_t>(v_)]; }
  const PinholeCamera& lens() const { return rig_.left_cameras[static_cast<std::size_t>(v_)].lens; }

  /// Landmarks in the image that have no feature yet, those that most keyframes saw first.
  std::vector<Candidate> candidates(const std::vector<int>& landmarks,
                                    const std::vector<int>& associations) const {
    std::vector<char> tied(map_.landmarks().size(), 0);
    for (const int id : associations) {
      if (id >= 0) tied[static_cast<std::size_t>(id)] = 1;
    }
    const Pose T_cam_map = rig_.left_cameras[static_cast<std::size_t>(v_)].T_cam_body * T_body_map_;
    std::vector<Candidate> result;
    for (const int id : landmarks) {
      const Landmark& landmark = map_.landmark(id);
      if (landmark.removed || tied[static_cast<std::size_t>(id)]) continue;
      const auto seen = view_landmark(landmark, T_cam_map, lens());
      if (seen) result.push_back({id, count_keyframes(landmark), seen->pixel, seen->depth});
    }
    std::stable_sort(result.begin(), result.end(), [](const Candidate& a, const Candidate& b) {
      return a.keyframes > b.keyframes;
    });
    return result;
  }

  /// Tries the oldest fitting patch, which has not drifted, then the newest.
  bool find(const Candidate& candidate) {
    const Landmark& landmark = map_.landmark(candidate.id);
    const std::vector<Observation>& seen = landmark.observations;
    for (auto o = seen.begin(); o != seen.end(); ++o) {
      const auto oldest = projector_.on_best_level(*o, v_, landmark);
      if (!oldest) continue;
      if (try_patch(*o, *oldest, candidate)) return true;
      for (auto newer = seen.rbegin(); &*newer != &*o; ++newer) {
        const auto newest = projector_.on_best_level(*newer, v_, landmark);
        if (newest) return try_patch(*newer, *newest, candidate);
      }
      return false;
    }
    return false;
  }

  bool try_patch(const Observation& seen, const PatchView& patch, const Candidate& candidate) {
    const auto level = static_cast<std::size_t>(patch.level);
    const auto v = static_cast<std::size_t>(v_);
    const double pixel = rig_.noise.level_scales[level];
    if (level >= frame_.pyramids[v].size()) return false;
    const auto fit =
        fit_patch(patch.window, frame_.pyramids[v][level], to_level(candidate.pixel.x(), pixel),
                  to_level(candidate.pixel.y(), pixel));
    if (!fit || !settings_.refinement.accepts(*fit)) return false;
    append(seen, patch.level, *fit, candidate);
    return true;
  }

  void append(const Observation& seen, int level, const PatchFit& fit, const Candidate& candidate) {
    const StereoView& then =
        map_.keyframe(seen.keyframe).frame->views[static_cast<std::size_t>(v_)];
    const double pixel = rig_.noise.level_scales[static_cast<std::size_t>(level)];
    Keypoint keypoint = then.features.keypoints[static_cast<std::size_t>(seen.feature)];
    keypoint.x = static_cast<float>(from_level(fit.x, pixel));
    keypoint.y = static_cast<float>(from_level(fit.y, pixel));
    keypoint.level = level;
    view().features.keypoints.push_back(keypoint);
    view().features.descriptors.push_back(map_.landmark(candidate.id).descriptor);
    view().stereo.push_back(find_in_right_image(keypoint, fit, candidate.depth));
    view().placed.push_back(1);
    ++view().followed;
  }

  StereoMatch find_in_right_image(const Keypoint& keypoint, const PatchFit& fit,
                                  double depth) const {
    StereoMatch match;
    const auto v = static_cast<std::size_t>(v_);
    const auto level = static_cast<std::size_t>(keypoint.level);
    if (frame_.right_pyramids[v].size() <= level) return match;
    const double pixel = rig_.noise.level_scales[level];
    const StereoCameraModel& camera = rig_.left_cameras[v];
    const Eigen::Vector2d at(keypoint.x, keypoint.y);
    const double level_disparity = camera.disparity_of(at, depth) / pixel;
    const auto aligned = align_patch(frame_.pyramids[v][level], frame_.right_pyramids[v][level],
                                     static_cast<int>(std::lround(fit.x)),
                                     static_cast<int>(std::lround(fit.y)), level_disparity);
    if (!aligned || aligned->shift <= 0 || !settings_.stereo.accepts(*aligned)) return match;
    const double disparity = aligned->shift * pixel;
    match.x_right = keypoint.x - static_cast<float>(disparity);
    match.slant_x = static_cast<float>(aligned->slope_x / disparity);
    match.slant_y = static_cast<float>(aligned->slope_y / disparity);
    const double seen_depth = camera.depth_of(at, disparity);
    if (seen_depth > 0 && seen_depth < settings_.stereo.max_depth_baselines * camera.baseline) {
      match.depth = static_cast<float>(seen_depth);
    }
    return match;
  }

  const Map& map_;
  Pose T_body_map_;
  const EstimatorRig& rig_;
  const FollowSettings& settings_;
  FrameFeatures& frame_;
  int v_;
  PatchProjector projector_;
};

}  // namespace

void follow_patches(const Map& map, const std::vector<int>& landmarks, const Pose& T_map_body,
                    const EstimatorRig& rig, const FollowSettings& settings, FrameFeatures& frame,
                    Associations& associations) {
  const RefinementConfig& refinement = settings.refinement;
  if (frame.pyramids.empty() || !refinement.enabled || refinement.follow == 0) return;
  for (std::size_t v = 0; v < associations.size(); ++v) {
    if (frame.pyramids[v].empty()) continue;
    Follower(map, T_map_body, rig, settings, frame, static_cast<int>(v))
        .follow(landmarks, associations[v]);
  }
}

}  // namespace vinebench::slam
