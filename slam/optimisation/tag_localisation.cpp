// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/tag_localisation.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/geometry/step_covariance.h"
#include "slam/factors/pose_manifold.h"
#include "slam/factors/tag_corner_factor.h"

namespace vinebench::slam {
namespace {

using Vector8d = Eigen::Matrix<double, 8, 1>;
using Matrix86d = Eigen::Matrix<double, 8, 6>;

/// How well the place of a tag is known beforehand.
constexpr double kPlaceSigma = 0.01;  // m
constexpr double kTurnSigma = 0.02;   // rad

/// 99.9 % of the chi-square distribution with eight degrees of freedom.
constexpr double kChiSquared8 = 26.12;

constexpr int kSteps = 6;

/// Errors of a sighting's corners in standard deviations, and their derivatives by the body's pose
/// and by the tag's.
struct CornerErrors {
  Vector8d residual;
  Matrix86d by_body;
  Matrix86d by_tag;
};

CornerErrors corner_errors(const PlacedSighting& seen, const Pose& T_ref_body,
                           const TagCameras& cameras, double systematic) {
  const StereoCameraModel& camera =
      cameras.undistorted[static_cast<std::size_t>(seen.sighting->camera)];
  const double sigma = corner_sigma(*seen.sighting, systematic);
  const std::array<Eigen::Vector3d, 4> corners = tag_corners(seen.size);
  const PoseBlock body = to_block(T_ref_body);
  const PoseBlock tag = to_block(seen.T_ref_tag);
  const double* parameters[] = {body.data(), tag.data()};
  CornerErrors errors;
  for (std::size_t c = 0; c < 4; ++c) {
    const TagCornerFactor error(camera, ideal_corner(*seen.sighting, c, cameras), sigma,
                                corners[c]);
    Eigen::Vector2d residual;
    Eigen::Matrix<double, 2, 7, Eigen::RowMajor> by_body;
    Eigen::Matrix<double, 2, 7, Eigen::RowMajor> by_tag;
    double* jacobians[] = {by_body.data(), by_tag.data()};
    error.Evaluate(parameters, residual.data(), jacobians);
    const auto row = static_cast<Eigen::Index>(2 * c);
    errors.residual.segment<2>(row) = residual;
    errors.by_body.middleRows<2>(row) = by_body.leftCols<6>();
    errors.by_tag.middleRows<2>(row) = by_tag.leftCols<6>();
  }
  return errors;
}

Matrix6d inverse(const Matrix6d& information) {
  return information.ldlt().solve(Matrix6d::Identity());
}

Matrix6d place_covariance() {
  return isotropic_covariance(kPlaceSigma, kTurnSigma);
}

/// Whether `other` is seen where it must be from the body's pose by another tag.
bool agrees(const PlacedSighting& other, const Pose& T_ref_body, const Matrix6d& covariance,
            const TagCameras& cameras, double systematic) {
  const CornerErrors at = corner_errors(other, T_ref_body, cameras, systematic);
  const Eigen::Matrix<double, 8, 8> expected =
      Eigen::Matrix<double, 8, 8>::Identity() + at.by_body * covariance * at.by_body.transpose() +
      at.by_tag * place_covariance() * at.by_tag.transpose();
  return at.residual.dot(expected.ldlt().solve(at.residual)) <= kChiSquared8;
}

/// Gauss-Newton over the corners of all sightings.
Pose refine(Pose T_ref_body, const std::vector<PlacedSighting>& seen, const TagCameras& cameras,
            double systematic) {
  for (int i = 0; i < kSteps; ++i) {
    Matrix6d H = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    for (const PlacedSighting& tag : seen) {
      const CornerErrors at = corner_errors(tag, T_ref_body, cameras, systematic);
      H += at.by_body.transpose() * at.by_body;
      g += at.by_body.transpose() * at.residual;
    }
    T_ref_body = T_ref_body * step_of(H.ldlt().solve(-g));
  }
  return T_ref_body;
}

}  // namespace

Matrix6d tag_covariance(const TagSighting& sighting, double size, const TagCameras& cameras,
                        double systematic) {
  const PlacedSighting seen{T_body_tag(sighting, cameras), size, &sighting};
  const Matrix86d J = corner_errors(seen, Pose{}, cameras, systematic).by_tag;
  return inverse(J.transpose() * J);
}

double pose_chi_squared(const Pose& a, const Pose& b, const Matrix6d& covariance) {
  const Pose T_a_b = a.inverse() * b;
  Vector6d difference;
  difference << T_a_b.translation, log_so3(T_a_b.rotation);
  return difference.dot(covariance.ldlt().solve(difference));
}

std::optional<Pose> locate_by_tags(const std::vector<PlacedSighting>& seen,
                                   const TagCameras& cameras, double systematic) {
  std::vector<PlacedSighting> best;
  Pose best_pose;
  double best_variance = 0;
  for (const PlacedSighting& tag : seen) {
    const Pose T_tag_body = T_body_tag(*tag.sighting, cameras).inverse();
    const Matrix6d by_tag = tag_covariance(*tag.sighting, tag.size, cameras, systematic);
    const Matrix6d covariance = carry_covariance(by_tag + place_covariance(), T_tag_body);
    const Pose T_ref_body = tag.T_ref_tag * T_tag_body;
    std::vector<PlacedSighting> together;
    for (const PlacedSighting& other : seen) {
      if (&other == &tag || agrees(other, T_ref_body, covariance, cameras, systematic)) {
        together.push_back(other);
      }
    }
    const double variance = covariance.topLeftCorner<3, 3>().trace();
    const bool better = together.size() > best.size() ||
                        (together.size() == best.size() && variance < best_variance);
    if (!better) continue;
    best = std::move(together);
    best_pose = T_ref_body;
    best_variance = variance;
  }
  if (2 * best.size() <= seen.size()) return std::nullopt;
  return best.size() == 1 ? best_pose : refine(best_pose, best, cameras, systematic);
}

}  // namespace vinebench::slam
