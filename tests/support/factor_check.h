// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/cost_function.h>
#include <gtest/gtest.h>

#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/factors/pose_manifold.h"

namespace vinebench::test {

inline slam::StereoCameraModel camera() {
  const PinholeCamera lens{752, 480, 263.2786, 263.2786, 375.5, 239.5, {}};
  return {lens, Pose{exp_so3({0.4, -1.1, 0.8}), {0.1, 0.05, -0.4}}, 0.12};
}

inline Pose body() {
  return {exp_so3({0.1, 0.2, -0.3}), {0.5, -0.2, 0.1}};
}

/// A point 1.5 m ahead of the camera, off its axis.
inline Eigen::Vector3d point() {
  return body() * (camera().T_cam_body.inverse() * Eigen::Vector3d(0.4, -0.3, 1.5));
}

/// Central differences by the manifold's own steps against the analytic Jacobian, every column.
inline void expect_jacobian(const ceres::CostFunction& cost,
                            std::vector<std::vector<double>> blocks) {
  const int rows = cost.num_residuals();
  std::vector<std::vector<double>> jacobians;
  std::vector<double*> parameters;
  std::vector<double*> jacobian_pointers;
  for (std::vector<double>& block : blocks) {
    jacobians.emplace_back(block.size() * static_cast<std::size_t>(rows));
    parameters.push_back(block.data());
  }
  for (auto& jacobian : jacobians) jacobian_pointers.push_back(jacobian.data());
  std::vector<double> residuals(static_cast<std::size_t>(rows));
  ASSERT_TRUE(cost.Evaluate(parameters.data(), residuals.data(), jacobian_pointers.data()));

  const double h = 1e-6;  // error of a central difference: about h^2 times the third derivative
  const slam::PoseManifold manifold;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t tangent = blocks[b].size() == 7 ? 6 : blocks[b].size();
    for (std::size_t c = 0; c < tangent; ++c) {
      std::vector<std::vector<double>> values;
      for (const double sign : {1.0, -1.0}) {
        std::vector<double> step(tangent, 0.0);
        step[c] = sign * h;
        std::vector<double> moved = blocks[b];
        if (blocks[b].size() == 7) {
          manifold.Plus(blocks[b].data(), step.data(), moved.data());
        } else {
          moved[c] += step[c];
        }
        std::vector<double*> at = parameters;
        at[b] = moved.data();
        values.emplace_back(static_cast<std::size_t>(rows));
        ASSERT_TRUE(cost.Evaluate(at.data(), values.back().data(), nullptr));
      }
      for (std::size_t r = 0; r < static_cast<std::size_t>(rows); ++r) {
        const double numeric = (values[0][r] - values[1][r]) / (2 * h);
        const double analytic = jacobians[b][r * blocks[b].size() + c];
        // Derivatives are of the order of 100 px/m; rounding leaves about 1e-13 * 100 / h = 1e-5.
        EXPECT_NEAR(analytic, numeric, 1e-4) << "block " << b << " row " << r << " column " << c;
      }
    }
  }
}

inline std::vector<double> as_vector(const slam::PoseBlock& block) {
  return {block.begin(), block.end()};
}

}  // namespace vinebench::test
