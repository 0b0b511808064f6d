// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/tag_measure_factor.h"

#include <gtest/gtest.h>

#include "slam/tags/tag_sightings.h"
#include "tests/support/factor_check.h"

namespace vinebench::slam {
namespace {

using namespace test;

/// Its own camera's mounting, a tag, and errors of its image.
struct Seen {
  StereoCameraModel model = camera();
  Pose T_map_tag{exp_so3({0.3, -0.2, 0.5}), point()};
  Pose T_body_cam = model.T_cam_body.inverse();
  Vector6d velocity = (Vector6d() << 0.5, 0.1, -0.05, 0.1, -0.2, 0.6).finished();
  Eigen::VectorXd errors = Eigen::VectorXd::LinSpaced(TagErrors::kNumbers, -0.4, 0.4) * 0.01;
};

TEST(TagMeasureFactorTest, JacobiansAreTheNumericOnes) {
  const Seen seen;
  for (int corner = 0; corner < 4; ++corner) {
    const auto index = static_cast<std::size_t>(corner);
    expect_jacobian(TagMeasureFactor(seen.model, {300, 250}, 0.3, tag_corners(0.161)[index], corner,
                                     seen.velocity, 0.004),
                    {as_vector(to_block(body())),
                     as_vector(to_block(seen.T_map_tag)),
                     as_vector(to_block(seen.T_body_cam)),
                     {0.03},
                     {seen.errors.begin(), seen.errors.end()}});
  }
}

// What a tag camera in its place sees of an exact tag is what it should see: no residual, if the
// body moves until it is taken or not.
TEST(TagMeasureFactorTest, IsZeroWhereTheImageIsAsItShouldBe) {
  const Seen seen;
  const Eigen::Vector3d corner = tag_corners(0.161)[2];
  const double late = 0.02;
  const Pose then = body() * step_of(seen.velocity * late);
  const Eigen::Vector3d p_body = then.inverse() * (seen.T_map_tag * corner);
  const Eigen::Vector2d pixel = seen.model.lens.project(seen.model.T_cam_body * p_body);
  const PoseBlock blocks[] = {to_block(body()), to_block(seen.T_map_tag),
                              to_block(seen.T_body_cam)};
  std::array<double, TagErrors::kNumbers> errors{};
  const double time = 0.001 + late;
  const double* parameters[] = {blocks[0].data(), blocks[1].data(), blocks[2].data(), &time,
                                errors.data()};
  std::array<double, 2> residuals;
  const TagMeasureFactor factor(seen.model, pixel, 0.5, corner, 2, seen.velocity, 0.001);
  factor.Evaluate(parameters, residuals.data(), nullptr);
  EXPECT_NEAR(residuals[0], 0, 1e-9);
  EXPECT_NEAR(residuals[1], 0, 1e-9);
  // The third corner's offset by 0.25 px is half of a standard deviation.
  errors[4] = 0.25;
  factor.Evaluate(parameters, residuals.data(), nullptr);
  EXPECT_NEAR(residuals[0], 0.5, 1e-9);
}

}  // namespace
}  // namespace vinebench::slam
