// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/matching/match_refiner.h"

#include "slam/frame/measurements.h"
#include "slam/matching/patch_projector.h"

namespace vinebench::slam {
namespace {

class Refiner {
 public:
  Refiner(const Map& map, const Pose& T_map_body, const EstimatorRig& rig,
          const RefinementConfig& config, FrameFeatures& frame)
      : projector_(map, view_poses(frame, T_map_body, rig), rig),
        noise_(rig.noise),
        config_(config),
        frame_(frame) {}

  /// Tries the oldest fitting patch, which has not drifted, then the newest. False where there are
  /// patches to compare with and none fits: the feature is not the landmark.
  bool refine(std::size_t v, std::size_t f, const Landmark& landmark) {
    const int view = static_cast<int>(v);
    const int level = frame_.views[v].features.keypoints[f].level;
    const std::vector<Observation>& seen = landmark.observations;
    for (auto o = seen.begin(); o != seen.end(); ++o) {
      const std::optional<PatchView> oldest = projector_.on_level(*o, view, landmark, level);
      if (!oldest) continue;
      if (try_patch(oldest->window, v, f)) return true;
      for (auto newer = seen.rbegin(); &*newer != &*o; ++newer) {
        const std::optional<PatchView> newest = projector_.on_level(*newer, view, landmark, level);
        if (newest) return try_patch(newest->window, v, f);
      }
      return false;
    }
    return true;
  }

 private:
  bool try_patch(const PatchWindow& window, std::size_t v, std::size_t f) {
    StereoView& view = frame_.views[v];
    Keypoint& keypoint = view.features.keypoints[f];
    const auto level = static_cast<std::size_t>(keypoint.level);
    const double pixel = noise_.level_scales[level];
    const auto fit = fit_patch(window, frame_.pyramids[v][level],
                               to_level(static_cast<double>(keypoint.x), pixel),
                               to_level(static_cast<double>(keypoint.y), pixel));
    if (!fit || !config_.accepts(*fit)) return false;
    const auto x = static_cast<float>(from_level(fit->x, pixel));
    if (view.stereo[f].depth > 0) view.stereo[f].x_right += x - keypoint.x;
    keypoint.x = x;
    keypoint.y = static_cast<float>(from_level(fit->y, pixel));
    view.placed[f] = 1;
    return true;
  }

  PatchProjector projector_;
  const MeasurementNoise& noise_;
  const RefinementConfig& config_;
  FrameFeatures& frame_;
};

}  // namespace

void refine_matches(const Map& map, const Pose& T_map_body, const EstimatorRig& rig,
                    const RefinementConfig& config, FrameFeatures& frame,
                    Associations& associations) {
  if (frame.pyramids.empty() || !config.enabled) return;
  Refiner refiner(map, T_map_body, rig, config, frame);
  for (std::size_t v = 0; v < associations.size(); ++v) {
    frame.views[v].placed.assign(associations[v].size(), 0);
    for (std::size_t f = 0; f < associations[v].size(); ++f) {
      int& landmark = associations[v][f];
      if (landmark >= 0 && !refiner.refine(v, f, map.landmark(landmark))) landmark = -1;
    }
  }
}

std::vector<PatchList> cut_patches(const FrameFeatures& frame, const Associations& landmarks,
                                   const MeasurementNoise& noise) {
  std::vector<PatchList> patches;
  if (frame.pyramids.empty()) return patches;
  for (std::size_t v = 0; v < landmarks.size(); ++v) {
    const StereoView& view = frame.views[v];
    PatchList& of_view = patches.emplace_back(landmarks[v].size());
    for (std::size_t f = 0; f < landmarks[v].size(); ++f) {
      if (landmarks[v][f] < 0 || !view.is_placed(f)) continue;
      const Keypoint& keypoint = view.features.keypoints[f];
      const auto level = static_cast<std::size_t>(keypoint.level);
      const double pixel = noise.level_scales[level];
      const auto patch =
          cut_patch(frame.pyramids[v][level], to_level(static_cast<double>(keypoint.x), pixel),
                    to_level(static_cast<double>(keypoint.y), pixel));
      if (patch) of_view.add(f, *patch);
    }
    of_view.close();
  }
  return patches;
}

}  // namespace vinebench::slam
