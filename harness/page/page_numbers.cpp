// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/page_numbers.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json brief(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::stod(fmt::format("{:.4g}", value));
}

Json decimal(double value) {
  return std::stod(fmt::format("{:.4f}", value));
}

std::array<double, 7> pose_values(const Pose& pose) {
  const Eigen::Vector3d& p = pose.translation;
  const Eigen::Vector4d q = pose.rotation.coeffs();
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

Json covariance_json(const Eigen::Matrix3d& R, const Eigen::Matrix3d& C) {
  const Eigen::Matrix3d m = R * C * R.transpose();
  return {brief(m(0, 0)), brief(m(0, 1)), brief(m(0, 2)),
          brief(m(1, 1)), brief(m(1, 2)), brief(m(2, 2))};
}

}  // namespace vinebench::harness
