// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

/// Accuracy of motion-only adjustment compared with theory, for rigs of one, two and three pairs.
/// Gaussian noise with the standard deviation that the estimator assumes.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slam/factors/robust_loss.h"
#include "slam/frame/measurements.h"
#include "slam/optimisation/motion_only_ba.h"
#include "tests/support/aisle_map.h"
#include "tests/support/rigs.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::rig_of_pairs;
using test::SyntheticAisle;

constexpr double kMinShare = 0.4;

Pose truth() {
  return {exp_so3({0.01, -0.02, 0.1}), {0.15, 0.05, 0.01}};
}

/// 4 cm and 2 degrees from the truth.
Pose prediction() {
  return truth() * Pose{exp_so3({0.02, 0.01, -0.03}), {0.03, -0.02, 0.01}};
}

/// The step of step_of from the truth to a pose.
Vector6d error_of(const Pose& pose) {
  Vector6d error;
  error << truth().rotation.conjugate() * (pose.translation - truth().translation),
      log_so3(truth().rotation.conjugate() * pose.rotation);
  return error;
}

/// Efficiency of the estimator's loss under Gaussian noise. Residuals r of a stereo match are three
/// standard normal numbers, s = |r|^2 is chi-square with three degrees of freedom. The estimate
/// solves sum J^T psi(r) = 0, psi(r) = w(s) r for s below the outliers' limit and 0 above. Its
/// covariance is (Huber, "Robust estimation of a location parameter", 1964) b / a^2 times F^-1, F =
/// sum J^T J the Fisher information whose inverse is the Cramer-Rao bound, with b = E[psi_i^2] and
/// a = E[d psi_i / d r_i], which is E[psi_i r_i] for normal noise (partial integration).
struct LossUnderNormalNoise {
  double inflation = 0;  ///< of the covariance over the bound: b / a^2
  double reported = 0;  ///< share of F that MotionEstimate::information is: E[w, s below the limit]
};

LossUnderNormalNoise loss_under_normal_noise() {
  const RobustLoss loss = RobustLoss::cauchy(kCauchyScale);
  double a = 0;
  double b = 0;
  double reported = 0;
  constexpr int kSteps = 20000;  // the midpoint rule's error is about 1e-8
  const double dt = std::sqrt(kChiSquared3) / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * dt;  // |r|, of density sqrt(2 / pi) t^2 exp(-t^2 / 2)
    const double p = std::sqrt(2 / std::numbers::pi) * t * t * std::exp(-t * t / 2) * dt;
    const double w = loss.weight(t * t);
    a += w * t * t / 3 * p;
    b += w * w * t * t / 3 * p;
    reported += w * p;
  }
  return {b / (a * a), reported};
}

/// An aisle without noise, its map, and a frame of it seen from the truth.
class MotionAccuracyTest : public testing::TestWithParam<int> {
 protected:
  static SyntheticAisle make_aisle(int pairs) {
    SyntheticAisle aisle(0, 1, 3000);
    aisle.rig = rig_of_pairs(aisle.rig, static_cast<std::size_t>(pairs));
    return aisle;
  }

  /// The frame with noise of the assumed size on each of a match's three numbers.
  FrameFeatures noisy(std::uint64_t seed) const {
    FrameFeatures result = *clean_;
    RandomSequence random(RandomStream(seed, "measurement"));
    for (StereoView& view : result.views) {
      for (std::size_t f = 0; f < view.features.size(); ++f) {
        Keypoint& keypoint = view.features.keypoints[f];
        const double sigma =
            known_.rig.noise.level_scales[static_cast<std::size_t>(keypoint.level)];
        keypoint.x += static_cast<float>(random.normal(0, sigma));
        keypoint.y += static_cast<float>(random.normal(0, sigma));
        view.stereo[f].x_right += static_cast<float>(random.normal(0, sigma));
      }
    }
    return result;
  }

  /// Of all `associations`, at the truth.
  Matrix6d fisher_information(const Associations& associations) const {
    Matrix6d F = Matrix6d::Zero();
    for (std::size_t v = 0; v < associations.size(); ++v) {
      for (std::size_t f = 0; f < associations[v].size(); ++f) {
        if (associations[v][f] < 0) continue;
        const Reprojection error(known_.rig.left_cameras[v],
                                 measure(clean_->views[v], static_cast<int>(f), known_.rig.noise));
        const auto J =
            error.linearise(truth(), known_.map.landmark(associations[v][f]).position).by_pose;
        F += J.transpose() * J;
      }
    }
    return F;
  }

  MotionEstimate estimate(const FrameFeatures& frame, Associations associations) const {
    return estimate_motion(known_.map, frame, prediction(), known_.rig, kMinShare, associations);
  }

  SyntheticAisle aisle_ = make_aisle(GetParam());
  AisleMap known_{aisle_, {Pose{}}};
  std::shared_ptr<FrameFeatures> clean_ = aisle_.frame(1, truth());
  Associations right_ = known_.associate(*clean_);
};

TEST_P(MotionAccuracyTest, IsExactWithoutNoise) {
  const MotionEstimate found = estimate(*clean_, right_);
  EXPECT_EQ(found.matches_per_view.size(), static_cast<std::size_t>(GetParam()));
  for (const int matches : found.matches_per_view) EXPECT_GT(matches, 40);
  // Pixels are floats: 1.5e-5 px in 263 at about a metre, some fifty landmarks and more.
  EXPECT_LT(error_of(found.T_map_body).head<3>().norm(), 1e-6);  // m
  EXPECT_LT(error_of(found.T_map_body).tail<3>().norm(), 1e-6);  // rad
}

TEST_P(MotionAccuracyTest, HasTheErrorThatTheoryForetells) {
  const Matrix6d F = fisher_information(right_);
  const LossUnderNormalNoise theory = loss_under_normal_noise();
  constexpr int kRuns = 400;
  Vector6d mean = Vector6d::Zero();
  double against_bound = 0;     // e^T F e, summed
  double against_reported = 0;  // normalised error squared, summed
  for (int run = 0; run < kRuns; ++run) {
    const MotionEstimate found = estimate(noisy(static_cast<std::uint64_t>(run) + 1), right_);
    const Vector6d e = error_of(found.T_map_body);
    mean += e / kRuns;
    against_bound += e.dot(F * e);
    against_reported += e.dot(found.information * e);
  }
  // Each sum over its expected factor is chi-square with 6 * 400 degrees of freedom: its standard
  // deviation is sqrt(2 / 2400) = 2.9 %. Four of these, and 3 % for some hundred matches being no
  // infinite number.
  constexpr double kTolerance = 4 * 0.029 + 0.03;
  EXPECT_NEAR(against_bound / (6 * kRuns * theory.inflation), 1, kTolerance);
  EXPECT_NEAR(against_reported / (6 * kRuns * theory.inflation * theory.reported), 1, kTolerance);
  // No bias: 99.99 % of chi-square with six degrees of freedom.
  EXPECT_LT(kRuns * mean.dot(F * mean) / theory.inflation, 27.9);
}

/// With Gaussian noise the loss costs a third of the information, and the reported information is
/// half of the actual one: the covariance is conservative.
TEST(MotionLossTest, IsCautiousUnderNormalNoise) {
  const LossUnderNormalNoise theory = loss_under_normal_noise();
  EXPECT_NEAR(theory.inflation, 1.485, 0.001);
  EXPECT_NEAR(theory.inflation * theory.reported, 0.504, 0.001);
}

TEST_P(MotionAccuracyTest, BearsOutliersUpToFortyPercent) {
  for (const int percent : {10, 20, 30, 40}) {
    Associations associations = right_;
    Associations good = right_;
    RandomSequence random(RandomStream(static_cast<std::uint64_t>(percent), "outliers"));
    for (std::size_t v = 0; v < right_.size(); ++v) {
      std::vector<int> tied;
      for (const int id : right_[v]) {
        if (id >= 0) tied.push_back(id);
      }
      for (std::size_t f = 0; f < right_[v].size(); ++f) {
        if (right_[v][f] < 0 || random.uniform() >= percent / 100.0) continue;
        associations[v][f] =
            tied[static_cast<std::size_t>(random.below(static_cast<int>(tied.size())))];
        good[v][f] = -1;
      }
    }
    const Matrix6d F = fisher_information(good);
    double sum = 0;
    constexpr int kRuns = 40;
    for (int run = 0; run < kRuns; ++run) {
      const FrameFeatures frame = noisy(static_cast<std::uint64_t>(1000 + run));
      const Vector6d e = error_of(estimate(frame, associations).T_map_body);
      sum += e.dot(F * e);
    }
    // As accurate as with the correct ones only, except for wrong ones that are within the limit by
    // chance: a tenth more error, squared and over four standard deviations of 240 degrees of
    // freedom.
    constexpr double factor = 1.1;
    const double expected = 6 * kRuns * loss_under_normal_noise().inflation;
    EXPECT_LT(sum, factor * factor * (1 + 4 * std::sqrt(2.0 / (6 * kRuns))) * expected) << percent;
  }
}

TEST_P(MotionAccuracyTest, OneWholeWrongViewIsOutvoted) {
  if (GetParam() == 1) GTEST_SKIP() << "of a single view nothing else could tell";
  const FrameFeatures frame = noisy(1);
  for (std::size_t wrong = 0; wrong < right_.size(); ++wrong) {
    Associations associations = right_;
    Associations good = right_;
    std::vector<int>& view = associations[wrong];
    std::rotate(view.begin(), view.begin() + static_cast<std::ptrdiff_t>(view.size() / 2),
                view.end());
    good[wrong].assign(good[wrong].size(), -1);
    const MotionEstimate found = estimate(frame, associations);
    EXPECT_EQ(found.inliers_per_view[wrong], 0) << wrong;
    // 99.99 % of chi-square with six degrees of freedom.
    const Vector6d e = error_of(found.T_map_body);
    EXPECT_LT(e.dot(fisher_information(good) * e) / loss_under_normal_noise().inflation, 27.9);
  }
}

INSTANTIATE_TEST_SUITE_P(Pairs, MotionAccuracyTest, testing::Values(1, 2, 3));

}  // namespace
}  // namespace vinebench::slam
