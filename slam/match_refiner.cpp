// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/match_refiner.h"

#include <Eigen/LU>
#include <cmath>

namespace vinebench {
namespace {

/// A patch that appears larger or smaller than this is another picture.
constexpr double kMaxScale = 1.4;

/// Level-0 pixels to pixels of a pyramid level, by pixel centres, and back.
double to_level(double v, double level_scale) {
  return (v + 0.5) / level_scale - 0.5;
}
double from_level(double v, double level_scale) {
  return (v + 0.5) * level_scale - 0.5;
}

class Refiner {
 public:
  Refiner(const Map& map, const Pose& T_map_body, const EstimatorRig& rig, FrameFeatures& frame)
      : map_(map), T_map_body_(T_map_body), rig_(rig), config_(rig.refinement), frame_(frame) {}

  /// Tries the oldest fitting patch, which has not drifted, then the newest. False where there are
  /// patches to compare with and none fits: the feature is not the landmark.
  bool refine(std::size_t v, std::size_t f, const Landmark& landmark) {
    const std::vector<Observation>& seen = landmark.observations;
    for (auto o = seen.begin(); o != seen.end(); ++o) {
      const std::optional<PatchWarp> warp = warp_of(*o, v, f, landmark);
      if (!warp) continue;
      if (try_patch(*o, *warp, v, f)) return true;
      for (auto newer = seen.rbegin(); &*newer != &*o; ++newer) {
        const std::optional<PatchWarp> newer_warp = warp_of(*newer, v, f, landmark);
        if (!newer_warp) continue;
        return try_patch(*newer, *newer_warp, v, f);
      }
      return false;
    }
    return true;
  }

 private:
  const std::optional<Patch>& patch_of(const Observation& o) const {
    return map_.keyframe(o.keyframe)
        .patches[static_cast<std::size_t>(o.view)][static_cast<std::size_t>(o.feature)];
  }

  /// How the patch of that observation appears on the feature's pyramid level: the homography of
  /// the landmark's plane, whose slant stereo told. None where there is no patch, or the change is
  /// such that it would be another picture.
  std::optional<PatchWarp> warp_of(const Observation& o, std::size_t v, std::size_t f,
                                   const Landmark& landmark) const {
    const Keyframe& keyframe = map_.keyframe(o.keyframe);
    if (keyframe.patches.empty() || static_cast<std::size_t>(o.view) != v || !patch_of(o)) {
      return std::nullopt;
    }
    const auto then_feature = static_cast<std::size_t>(o.feature);
    const StereoView& then = keyframe.frame->views[v];
    const Keypoint& seen = then.features.keypoints[then_feature];
    const Pose T_then_map = (keyframe.T_map_body * rig_.T_body_cams[v]).inverse();
    const Pose T_now_then = (T_map_body_ * rig_.T_body_cams[v]).inverse() * T_then_map.inverse();
    const double depth = (T_then_map * landmark.position).z();
    if (depth < 0.05) return std::nullopt;

    const PinholeCamera& lens = rig_.eyes[v].lens;
    Eigen::Matrix3d K;
    K << lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1;
    const StereoMatch& stereo = then.stereo[then_feature];
    // Inverse depth is linear in the picture of a plane: rho = inverse . (x, y, 1).
    const Eigen::RowVector3d inverse =
        Eigen::RowVector3d(stereo.slant_x, stereo.slant_y,
                           1 - static_cast<double>(stereo.slant_x * seen.x) -
                               static_cast<double>(stereo.slant_y * seen.y)) /
        depth;
    const Eigen::Matrix3d H_now_then = K * (T_now_then.rotation.toRotationMatrix() * K.inverse() +
                                            T_now_then.translation * inverse);
    return within_limits(level_of(f, v) * H_now_then * patch_pixels(seen));
  }

  /// Patch pixels, its centre at (0, 0), to pixels of level 0.
  Eigen::Matrix3d patch_pixels(const Keypoint& seen) const {
    const double pixel = rig_.level_scales[static_cast<std::size_t>(seen.level)];
    Eigen::Matrix3d S;
    S << pixel, 0, static_cast<double>(seen.x), 0, pixel, static_cast<double>(seen.y), 0, 0, 1;
    return S;
  }

  /// Pixels of level 0 to those of the feature's level, but for the origin, which a warp ignores.
  Eigen::Matrix3d level_of(std::size_t f, std::size_t v) const {
    const Keypoint& now = frame_.views[v].features.keypoints[f];
    const double pixel = rig_.level_scales[static_cast<std::size_t>(now.level)];
    return Eigen::Vector3d(1 / pixel, 1 / pixel, 1).asDiagonal();
  }

  static std::optional<PatchWarp> within_limits(const Eigen::Matrix3d& H) {
    // All of the patch must be before the camera.
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        if ((H * Eigen::Vector3d(x * Patch::kRadius, y * Patch::kRadius, 1)).z() < 0.2 * H(2, 2)) {
          return std::nullopt;
        }
      }
    }
    const PatchWarp warp = make_warp(H);
    const double area = std::abs(static_cast<double>(warp.jacobian.determinant()));
    const bool alike = area < kMaxScale * kMaxScale && area > 1 / (kMaxScale * kMaxScale);
    return alike ? std::optional(warp) : std::nullopt;
  }

  bool try_patch(const Observation& o, const PatchWarp& warp, std::size_t v, std::size_t f) {
    StereoView& view = frame_.views[v];
    Keypoint& keypoint = view.features.keypoints[f];
    const auto level = static_cast<std::size_t>(keypoint.level);
    const double pixel = rig_.level_scales[level];
    const auto fit = fit_patch(*patch_of(o), warp, frame_.pyramids[v][level],
                               to_level(static_cast<double>(keypoint.x), pixel),
                               to_level(static_cast<double>(keypoint.y), pixel));
    if (!fit || fit->difference > config_.noise + config_.max_residual * fit->contrast) {
      return false;
    }
    const auto x = static_cast<float>(from_level(fit->x, pixel));
    if (view.stereo[f].depth > 0) view.stereo[f].x_right += x - keypoint.x;
    keypoint.x = x;
    keypoint.y = static_cast<float>(from_level(fit->y, pixel));
    view.placed[f] = 1;
    return true;
  }

  const Map& map_;
  Pose T_map_body_;
  const EstimatorRig& rig_;
  RefinementConfig config_;
  FrameFeatures& frame_;
};

}  // namespace

void refine_matches(const Map& map, const Pose& T_map_body, const EstimatorRig& rig,
                    FrameFeatures& frame, Associations& associations) {
  if (frame.pyramids.empty() || !rig.refinement.enabled) return;
  Refiner refiner(map, T_map_body, rig, frame);
  for (std::size_t v = 0; v < associations.size(); ++v) {
    frame.views[v].placed.assign(associations[v].size(), 0);
    for (std::size_t f = 0; f < associations[v].size(); ++f) {
      int& landmark = associations[v][f];
      if (landmark >= 0 && !refiner.refine(v, f, map.landmark(landmark))) landmark = -1;
    }
  }
}

std::vector<std::vector<std::optional<Patch>>> cut_patches(const FrameFeatures& frame,
                                                           const Associations& landmarks,
                                                           const EstimatorRig& rig) {
  std::vector<std::vector<std::optional<Patch>>> patches;
  if (frame.pyramids.empty() || !rig.refinement.enabled) return patches;
  for (std::size_t v = 0; v < landmarks.size(); ++v) {
    const StereoView& view = frame.views[v];
    std::vector<std::optional<Patch>>& of_view = patches.emplace_back(landmarks[v].size());
    for (std::size_t f = 0; f < landmarks[v].size(); ++f) {
      if (landmarks[v][f] < 0 || !view.is_placed(f)) continue;
      const Keypoint& keypoint = view.features.keypoints[f];
      const auto level = static_cast<std::size_t>(keypoint.level);
      const double pixel = rig.level_scales[level];
      of_view[f] =
          cut_patch(frame.pyramids[v][level], to_level(static_cast<double>(keypoint.x), pixel),
                    to_level(static_cast<double>(keypoint.y), pixel));
    }
  }
  return patches;
}

}  // namespace vinebench
