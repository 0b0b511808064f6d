// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/map/rig_fingerprint.h"

#include <algorithm>
#include <cmath>

namespace vinebench::slam {
namespace {

/// Equal but for the roundings of a calibration that was computed again.
bool alike(double a, double b) {
  return std::abs(a - b) <= 1e-6 * std::max({1.0, std::abs(a), std::abs(b)});
}
bool alike(const PinholeCamera& a, const PinholeCamera& b) {
  return a.width == b.width && a.height == b.height && alike(a.fx, b.fx) && alike(a.fy, b.fy) &&
         alike(a.cx, b.cx) && alike(a.cy, b.cy) && a.lens == b.lens &&
         std::equal(a.distortion.begin(), a.distortion.end(), b.distortion.begin(),
                    [](double x, double y) { return alike(x, y); });
}
bool alike(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm() <= 1e-6 &&
         angle_of(a.rotation.conjugate() * b.rotation) <= 1e-6;
}

}  // namespace

RigFingerprint rig_fingerprint(const EstimatorRig& rig) {
  RigFingerprint print;
  for (const RigCamera& c : rig.rig.cameras)
    print.cameras.push_back({c.name, c.model, c.T_body_cam});
  for (const RectifiedPair& p : rig.rig.pairs) {
    print.pairs.push_back(
        {p.name, p.left_camera, p.right_camera, p.lens, p.baseline, p.T_body_cam});
  }
  print.level_scales = rig.noise.level_scales;
  return print;
}

std::string difference(const RigFingerprint& map, const RigFingerprint& rig) {
  if (map.cameras.size() != rig.cameras.size()) {
    return fmt::format("it has {} cameras, this one {}", map.cameras.size(), rig.cameras.size());
  }
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const RigFingerprint::Camera& a = map.cameras[i];
    const RigFingerprint::Camera& b = rig.cameras[i];
    if (a.name != b.name) return fmt::format("its camera {} is '{}', here '{}'", i, a.name, b.name);
    if (!alike(a.model, b.model)) return fmt::format("camera '{}' has another lens", a.name);
    if (!alike(a.T_body_cam, b.T_body_cam)) {
      return fmt::format("camera '{}' sits elsewhere", a.name);
    }
  }
  if (map.pairs.size() != rig.pairs.size()) {
    return fmt::format("it uses {} stereo pairs, this one {}", map.pairs.size(), rig.pairs.size());
  }
  for (std::size_t i = 0; i < rig.pairs.size(); ++i) {
    const RigFingerprint::Pair& a = map.pairs[i];
    const RigFingerprint::Pair& b = rig.pairs[i];
    if (a.name != b.name) return fmt::format("its pair {} is '{}', here '{}'", i, a.name, b.name);
    const bool same = a.left_camera == b.left_camera && a.right_camera == b.right_camera &&
                      alike(a.lens, b.lens) && alike(a.baseline, b.baseline) &&
                      alike(a.T_body_cam, b.T_body_cam);
    if (!same) return fmt::format("pair '{}' has another calibration", a.name);
  }
  if (map.level_scales.size() != rig.level_scales.size() ||
      !std::equal(rig.level_scales.begin(), rig.level_scales.end(), map.level_scales.begin(),
                  [](double a, double b) { return alike(a, b); })) {
    return "its features have another scale pyramid";
  }
  return {};
}

}  // namespace vinebench::slam
