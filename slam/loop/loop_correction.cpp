// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/loop_correction.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/geometry/step_covariance.h"

namespace vinebench::slam {
namespace {

/// A step of no length is uncertain too.
constexpr double kShortestStep = 0.01;  // m

Matrix6d step_covariance(const Keyframe& keyframe, const Pose& T_before_now) {
  if (keyframe.link) return keyframe.link->covariance;
  const double length = std::max(T_before_now.translation.norm(), kShortestStep);
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(kStepOffset * kStepOffset * length),
      Eigen::Vector3d::Constant(kStepTurn * kStepTurn * length);
  return variances.asDiagonal();
}

/// A keyframe on the way, before it is moved.
struct Step {
  Pose T_map_body;
  Pose T_before_now;
  Matrix6d covariance;
  Matrix6d of_last;  ///< the step of the last keyframe that one of this keyframe makes
};

std::vector<Step> steps_between(const Map& map, int first, int last) {
  const Pose& T_map_last = map.keyframe(last).T_map_body;
  std::vector<Step> steps;
  for (int k = first + 1; k <= last; ++k) {
    const Keyframe& now = map.keyframe(k);
    const Pose T_before_now = map.keyframe(k - 1).T_map_body.inverse() * now.T_map_body;
    steps.push_back({now.T_map_body, T_before_now, step_covariance(now, T_before_now),
                     carried_step(now.T_map_body.inverse() * T_map_last)});
  }
  return steps;
}

}  // namespace

void spread_correction(Map& map, int first, int last, const Pose& corrected,
                       const Matrix6d& covariance) {
  const std::vector<Step> steps = steps_between(map, first, last);
  Matrix6d expected = covariance;
  for (const Step& s : steps) expected += s.of_last * s.covariance * s.of_last.transpose();
  const Pose error = map.keyframe(last).T_map_body.inverse() * corrected;
  Vector6d step;
  step << error.translation, log_so3(error.rotation);
  const Vector6d pull = expected.ldlt().solve(step);

  std::vector<Pose> moves(map.keyframes().size());
  Pose T_map_now = map.keyframe(first).T_map_body;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& s = steps[i];
    T_map_now = T_map_now * s.T_before_now * step_of(s.covariance * s.of_last.transpose() * pull);
    const int k = first + 1 + static_cast<int>(i);
    moves[static_cast<std::size_t>(k)] = T_map_now * s.T_map_body.inverse();
    map.keyframe(k).T_map_body = T_map_now;
  }
  for (Landmark& landmark : map.landmarks()) {
    landmark.position =
        moves[static_cast<std::size_t>(landmark.first_keyframe)] * landmark.position;
  }
}

void move_map(Map& map, const Pose& T_new_old) {
  move_from(map, 0, T_new_old);
  for (MapTag& tag : map.tags()) {
    if (!map.is_held(tag)) tag.T_map_tag = T_new_old * tag.T_map_tag;
  }
  if (!map.gravity()) return;
  MapGravity& known = *map.gravity();
  known.gravity = T_new_old.rotation * known.gravity;
  Matrix6d carried = Matrix6d::Identity();
  carried.topLeftCorner<3, 3>() = T_new_old.rotation.toRotationMatrix();
  known.covariance = carried * known.covariance * carried.transpose();
}

Pose keep_world(Map& map, const Pose& T_map_world_before) {
  const Pose T_new_old = T_map_world_before * map.world()->inverse();
  map.world() = T_map_world_before;
  move_map(map, T_new_old);
  return T_new_old;
}

void move_from(Map& map, int first, const Pose& T_new_old) {
  for (Keyframe& keyframe : map.keyframes()) {
    if (keyframe.id >= first) keyframe.T_map_body = T_new_old * keyframe.T_map_body;
  }
  for (Landmark& landmark : map.landmarks()) {
    if (landmark.first_keyframe >= first) landmark.position = T_new_old * landmark.position;
  }
}

}  // namespace vinebench::slam
