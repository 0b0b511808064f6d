// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "slam/camera/estimator_rig.h"

namespace vinebench::slam {

/// What a map depends on of the rig that made it.
struct RigFingerprint {
  struct Camera {
    std::string name;
    PinholeCamera model;
    Pose T_body_cam;
  };
  struct Pair {
    std::string name;
    int left_camera = 0;
    int right_camera = 0;
    PinholeCamera lens;
    double baseline = 0;
    Pose T_body_cam;
  };
  std::vector<Camera> cameras;
  std::vector<Pair> pairs;
  std::vector<double> level_scales;
};

RigFingerprint rig_fingerprint(const EstimatorRig& rig);

/// How the rig of a map differs from the one in use, the first difference only; empty where they
/// are the same but for the roundings of a calibration that was computed again.
std::string difference(const RigFingerprint& map, const RigFingerprint& rig);

template <class Archive>
void fields(Archive& archive, PinholeCamera& c) {
  archive(c.width, c.height, c.fx, c.fy, c.cx, c.cy);
  constexpr std::size_t kBefore5 = 4;  // coefficients; version 5 has a lens model
  for (std::size_t i = 0; i < kBefore5; ++i) archive(c.distortion[i]);
  if (archive.version() < 5) return;
  auto lens = static_cast<std::int32_t>(c.lens);
  archive(c.distortion[kBefore5], lens);
  c.lens = static_cast<LensModel>(lens);
}
template <class Archive>
void fields(Archive& archive, RigFingerprint::Camera& c) {
  archive(c.name, c.model, c.T_body_cam);
}
template <class Archive>
void fields(Archive& archive, RigFingerprint::Pair& p) {
  archive(p.name, p.left_camera, p.right_camera, p.lens, p.baseline, p.T_body_cam);
}
template <class Archive>
void fields(Archive& archive, RigFingerprint& rig) {
  archive(rig.cameras, rig.pairs, rig.level_scales);
}
}  // namespace vinebench::slam
