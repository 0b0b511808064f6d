// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/matching/patch_projector.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/frame/measurements.h"

namespace vinebench::slam {
namespace {

/// A patch that appears larger or smaller than this is another image.
constexpr double kMaxScale = 1.4;

constexpr double kMinDepth = 0.05;  // m

Eigen::Matrix3d calibration(const PinholeCamera& lens) {
  Eigen::Matrix3d K;
  K << lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1;
  return K;
}

/// Whether the plane does not come near the camera within the patch.
bool wholly_in_front(const Eigen::Matrix3d& H) {
  return H(2, 2) - Patch::kRadius * (std::abs(H(2, 0)) + std::abs(H(2, 1))) > 0.2 * H(2, 2);
}

/// Pixels of the image to a pixel of the patch, about its centre.
double magnification(const Eigen::Matrix3d& H) {
  const Eigen::Vector2d at = (H.col(2)).hnormalized();
  Eigen::Matrix2d J;
  J.col(0) = (H.col(0).head<2>() - at * H(2, 0)) / H(2, 2);
  J.col(1) = (H.col(1).head<2>() - at * H(2, 1)) / H(2, 2);
  return std::sqrt(std::abs(J.determinant()));
}

}  // namespace

PatchProjector::PatchProjector(const Map& map, std::vector<Pose> T_map_bodies,
                               const EstimatorRig& rig)
    : map_(map), T_map_bodies_(std::move(T_map_bodies)), rig_(rig) {
  steps_.assign(rig.left_cameras.size(), std::vector<std::optional<Step>>(map.keyframes().size()));
}

const Patch* PatchProjector::find_patch(const Observation& seen) const {
  const Keyframe& keyframe = map_.keyframe(seen.keyframe);
  if (keyframe.patches.empty()) return nullptr;
  return keyframe.patches[static_cast<std::size_t>(seen.view)].find(
      static_cast<std::size_t>(seen.feature));
}

const PatchProjector::Step& PatchProjector::step(int keyframe, int v) {
  std::optional<Step>& step =
      steps_[static_cast<std::size_t>(v)][static_cast<std::size_t>(keyframe)];
  if (step) return *step;
  const auto view = static_cast<std::size_t>(v);
  const Pose& T_body_cam = rig_.T_body_cams[view];
  const Keyframe& then = map_.keyframe(keyframe);
  const Pose T_then_map =
      (view_pose(*then.frame, view, then.T_map_body, rig_) * T_body_cam).inverse();
  const Pose T_now_then = (T_map_bodies_[view] * T_body_cam).inverse() * T_then_map.inverse();
  const Eigen::Matrix3d K = calibration(rig_.left_cameras[static_cast<std::size_t>(v)].lens);
  step = Step{K * T_now_then.rotation.toRotationMatrix() * K.inverse(), K * T_now_then.translation,
              T_then_map};
  return *step;
}

std::optional<Eigen::Matrix3d> PatchProjector::homography(const Observation& seen, int v,
                                                          const Landmark& landmark) {
  if (seen.view != v || find_patch(seen) == nullptr) return std::nullopt;
  const Step& step = this->step(seen.keyframe, v);
  const double depth = (step.T_then_map * landmark.position).z();
  if (depth < kMinDepth) return std::nullopt;
  const StereoView& then = map_.keyframe(seen.keyframe).frame->views[static_cast<std::size_t>(v)];
  const auto f = static_cast<std::size_t>(seen.feature);
  const Keypoint& corner = then.features.keypoints[f];
  const StereoMatch& stereo = then.stereo[f];
  // Inverse depth is linear in the image of a plane: rho = inverse . (x, y, 1).
  const Eigen::RowVector3d inverse =
      Eigen::RowVector3d(stereo.slant_x, stereo.slant_y,
                         1 - static_cast<double>(stereo.slant_x * corner.x) -
                             static_cast<double>(stereo.slant_y * corner.y)) /
      depth;
  const double pixel = rig_.noise.level_scales[static_cast<std::size_t>(corner.level)];
  Eigen::Matrix3d from_patch;
  from_patch << pixel, 0, static_cast<double>(corner.x), 0, pixel, static_cast<double>(corner.y), 0,
      0, 1;
  const Eigen::Matrix3d H = (step.turn + step.shift * inverse) * from_patch;
  if (!(H(2, 2) > 0) || !wholly_in_front(H)) return std::nullopt;
  return H;
}

std::optional<PatchView> PatchProjector::view_on(const Eigen::Matrix3d& H, const Patch& patch,
                                                 int level) const {
  const double pixel = rig_.noise.level_scales[static_cast<std::size_t>(level)];
  const double scale = magnification(H) / pixel;
  if (!(scale < kMaxScale && scale > 1 / kMaxScale)) return std::nullopt;
  // The origin of the level's pixels does not matter: a window is about its centre.
  const auto window = warp_patch(patch, Eigen::Vector3d(1 / pixel, 1 / pixel, 1).asDiagonal() * H);
  return window ? std::optional(PatchView{level, *window}) : std::nullopt;
}

std::optional<PatchView> PatchProjector::on_level(const Observation& seen, int v,
                                                  const Landmark& landmark, int level) {
  const auto H = homography(seen, v, landmark);
  return H ? view_on(*H, *find_patch(seen), level) : std::nullopt;
}

std::optional<PatchView> PatchProjector::on_best_level(const Observation& seen, int v,
                                                       const Landmark& landmark) {
  const auto H = homography(seen, v, landmark);
  if (!H) return std::nullopt;
  const double level = std::log(magnification(*H)) / std::log(map_.level_scale());
  const int top = static_cast<int>(rig_.noise.level_scales.size()) - 1;
  return view_on(*H, *find_patch(seen), std::clamp(static_cast<int>(std::lround(level)), 0, top));
}

}  // namespace vinebench::slam
