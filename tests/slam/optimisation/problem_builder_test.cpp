// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/problem_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <memory>

#include "tests/support/write_poses.h"

namespace vinebench::slam {
namespace {

// The solver's damping leaves 1e-4 of a step's rest twice: 1e-8.

/// The residual x - wanted.
class Wish : public ceres::SizedCostFunction<1, 1> {
 public:
  explicit Wish(double wanted) : wanted_(wanted) {}
  bool Evaluate(double const* const* x, double* residual, double** jacobian) const override {
    residual[0] = x[0][0] - wanted_;
    if (jacobian != nullptr && jacobian[0] != nullptr) jacobian[0][0] = 1;
    return true;
  }

 private:
  double wanted_;
};

/// The residual p - wanted of a pose's position.
class Place : public ceres::SizedCostFunction<3, 7> {
 public:
  explicit Place(const Eigen::Vector3d& wanted) : wanted_(wanted) {}
  bool Evaluate(double const* const* x, double* residual, double** jacobian) const override {
    const Pose pose = from_block(x[0]);
    Eigen::Map<Eigen::Vector3d>{residual} = pose.translation - wanted_;
    if (jacobian != nullptr && jacobian[0] != nullptr) {
      // By the manifold's step: the body's own axes.
      Eigen::Map<Eigen::Matrix<double, 3, 7, Eigen::RowMajor>> by_pose(jacobian[0]);
      by_pose.setZero();
      by_pose.leftCols<3>() = pose.rotation.toRotationMatrix();
    }
    return true;
  }

 private:
  Eigen::Vector3d wanted_;
};

/// A linear residual of a pose's position, of a landmark and of an offset.
class Mixture : public ceres::SizedCostFunction<1, 7, 1, 1> {
 public:
  explicit Mixture(double phase) : phase_(phase) {}
  bool Evaluate(double const* const* x, double* residual, double** jacobian) const override {
    const Pose pose = from_block(x[0]);
    const Eigen::Vector3d a(std::sin(phase_), std::sin(2 * phase_), std::sin(3 * phase_));
    const double b = std::cos(phase_), c = std::cos(2 * phase_);
    residual[0] = a.dot(pose.translation) + b * x[1][0] + c * x[2][0] - std::sin(7 * phase_);
    if (jacobian == nullptr) return true;
    if (jacobian[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 1, 7>> by_pose(jacobian[0]);
      by_pose.setZero();
      by_pose.leftCols<3>() = a.transpose() * pose.rotation.toRotationMatrix();
    }
    if (jacobian[1] != nullptr) jacobian[1][0] = b;
    if (jacobian[2] != nullptr) jacobian[2][0] = c;
    return true;
  }

 private:
  double phase_;
};

ceres::Solver::Options dense_schur() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 5;
  options.logging_type = ceres::SILENT;
  return options;
}

ceres::Solver::Options dense_qr() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  return options;
}

class ProblemBuilderTest : public testing::Test {
 protected:
  ProblemBuilderTest() {
    for (int k = 0; k < 4; ++k) {
      map_.add_keyframe(std::make_shared<FrameFeatures>(),
                        {exp_so3({0, 0, 0.3 * k}), {1.0 * k, 0, 0}}, {});
    }
  }
  Map map_{1.2};
  const AdjustmentWindow window_{{1, 3}, {0}};
};

TEST_F(ProblemBuilderTest, TheWindowsKeyframesTakePartWithTheirPoses) {
  ProblemBuilder problem(map_, window_);
  EXPECT_TRUE(problem.takes_part(0) && problem.takes_part(1) && problem.takes_part(3));
  EXPECT_FALSE(problem.takes_part(2));
  for (const int id : {0, 1, 3}) {
    const Pose pose = from_block(problem.pose_of(id));
    EXPECT_LT((pose.translation - map_.keyframe(id).T_map_body.translation).norm(), 1e-12);
    EXPECT_LT(angle_of(pose.rotation.conjugate() * map_.keyframe(id).T_map_body.rotation), 1e-7);
  }
}

/// The pose of keyframe 1 after an adjustment with this offset.
PoseBlock adjusted(const Map& map, const AdjustmentWindow& window, double& offset) {
  std::deque<Mixture> factors;
  for (int i = 1; i <= 40; ++i) factors.emplace_back(0.37 * i);
  double landmark = 0;
  offset = 0;
  ProblemBuilder problem(map, window);
  problem.add_block(&landmark, 1, ProblemBuilder::Group::kLandmarks);
  problem.add_block(&offset, 1, ProblemBuilder::Group::kLenses);
  for (std::size_t i = 0; i < factors.size(); ++i) {
    problem.add_factor(factors[i], nullptr,
                       {problem.pose_of(i % 2 == 0 ? 1 : 3), &landmark, &offset});
  }
  problem.solve(dense_schur());
  PoseBlock pose{};
  std::copy_n(problem.pose_of(1), pose.size(), pose.data());
  return pose;
}

TEST_F(ProblemBuilderTest, WhereABlockLiesInMemoryChangesNoBit) {
  // The builder's poses are on the heap. One of these lies below it and one above, wherever a
  // system puts them.
  static double below = 0;
  double above = 0;
  EXPECT_EQ(adjusted(map_, window_, below), adjusted(map_, window_, above));
}

/// The residual a x + b y.
class Line : public ceres::SizedCostFunction<1, 1, 1> {
 public:
  Line(double a, double b) : a_(a), b_(b) {}
  bool Evaluate(double const* const* x, double* residual, double** jacobian) const override {
    residual[0] = a_ * x[0][0] + b_ * x[1][0];
    if (jacobian == nullptr) return true;
    if (jacobian[0] != nullptr) jacobian[0][0] = a_;
    if (jacobian[1] != nullptr) jacobian[1][0] = b_;
    return true;
  }

 private:
  double a_, b_;
};

// Normal equations of (x, y) for the residuals x - 1, x + 2 y, 3 y: [1 + 1, 2; 2, 4 + 9]. Of y with
// x unknown too: 13 - 2 * 2 / 2 = 11. The poses, which nothing holds, take no part in it.
TEST_F(ProblemBuilderTest, InformationOfTheLastUnknownsIsTheirSchurComplement) {
  Wish wish(1);
  Line line(1, 2), slope(0, 3);
  double landmark = 0, offset = 0;
  ProblemBuilder problem(map_, window_);
  problem.add_block(&landmark, 1, ProblemBuilder::Group::kLandmarks);
  problem.add_block(&offset, 1, ProblemBuilder::Group::kLenses);
  problem.add_factor(wish, nullptr, {&landmark});
  problem.add_factor(line, nullptr, {&landmark, &offset});
  problem.add_factor(slope, nullptr, {&landmark, &offset});
  const Eigen::MatrixXd information =
      problem.marginal({ProblemBuilder::Group::kLenses}).information;
  ASSERT_EQ(information.size(), 1);
  EXPECT_NEAR(information(0, 0), 11, 1e-7);  // the damping of unknowns that nothing holds: 1e-9
}

/// The residual p - offset a of a pose's position.
class Tied : public ceres::SizedCostFunction<3, 7, 1> {
 public:
  explicit Tied(const Eigen::Vector3d& a) : a_(a) {}
  bool Evaluate(double const* const* x, double* residual, double** jacobian) const override {
    const Pose pose = from_block(x[0]);
    Eigen::Map<Eigen::Vector3d>{residual} = pose.translation - x[1][0] * a_;
    if (jacobian == nullptr) return true;
    if (jacobian[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 3, 7, Eigen::RowMajor>> by_pose(jacobian[0]);
      by_pose.setZero();
      by_pose.leftCols<3>() = pose.rotation.toRotationMatrix();
    }
    if (jacobian[1] != nullptr) Eigen::Map<Eigen::Vector3d>{jacobian[1]} = -a_;
    return true;
  }

 private:
  Eigen::Vector3d a_;
};

// An offset of 1 takes the pose by (3, 0, 1) along with it; steps are in the body's own axes. Of
// the offset itself, only its own wish is left: 1.
TEST_F(ProblemBuilderTest, TheLastPoseFollowsTheLastUnknowns) {
  const Eigen::Vector3d a(3, 0, 1);
  Tied tied(a);
  Wish wish(1);
  double offset = 0;
  ProblemBuilder problem(map_, window_);
  problem.add_block(&offset, 1, ProblemBuilder::Group::kLenses);
  problem.add_factor(tied, nullptr, {problem.pose_of(window_.moved.back()), &offset});
  problem.add_factor(wish, nullptr, {&offset});
  const ProblemBuilder::Marginal marginal = problem.marginal({ProblemBuilder::Group::kLenses});
  EXPECT_NEAR(marginal.information(0, 0), 1, 1e-7);  // damping, as above
  ASSERT_EQ(marginal.of_last_pose.rows(), 6);
  const Pose& last = map_.keyframe(window_.moved.back()).T_map_body;
  const Eigen::Vector3d expected = last.rotation.conjugate() * a;
  EXPECT_LT((marginal.of_last_pose.col(0).head<3>() - expected).norm(), 1e-7);
  EXPECT_EQ(marginal.of_last_pose.col(0).tail<3>().norm(), 0);
}

TEST_F(ProblemBuilderTest, OnlyMovedKeyframesMoveAndAreWrittenBack) {
  ProblemBuilder problem(map_, window_);
  Place left({3, 1, 0}), start({0, 0, 2});
  problem.add_factor(left, nullptr, {problem.pose_of(3)});
  problem.add_factor(start, nullptr, {problem.pose_of(0)});
  // Keyframe 0 is held 2 m off: half of 4.
  EXPECT_NEAR(problem.solve(dense_qr()), 2, 1e-12);
  EXPECT_EQ(map_.keyframe(3).T_map_body.translation, Eigen::Vector3d(3, 0, 0));
  test::write_poses(problem, map_);
  EXPECT_LT((map_.keyframe(3).T_map_body.translation - Eigen::Vector3d(3, 1, 0)).norm(), 1e-7);
  EXPECT_EQ(map_.keyframe(0).T_map_body.translation, Eigen::Vector3d(0, 0, 0));
  // Positions alone were asked for: the heading of 0.9 rad stays.
  EXPECT_NEAR(angle_of(map_.keyframe(3).T_map_body.rotation), 0.9, 1e-7);
}

TEST_F(ProblemBuilderTest, BlocksOfOthersCanBeHeld) {
  double point = 1, other = 5;
  ProblemBuilder problem(map_, window_);
  problem.add_block(&point, 1, ProblemBuilder::Group::kLandmarks);
  problem.add_block(&other, 1, ProblemBuilder::Group::kLenses);
  problem.hold(&other);
  Wish four(4), two(2);
  problem.add_factor(four, nullptr, {&point});
  problem.add_factor(two, nullptr, {&other});
  EXPECT_NEAR(problem.solve(dense_qr()), 0.5 * 9, 1e-9);
  EXPECT_NEAR(point, 4, 1e-7);
  EXPECT_EQ(other, 5);
}

/// Where a landmark at some distance, 0 m aside, is seen by a camera that is turned: in px, for a
/// focal length of 400 px.
class Bearing : public ceres::SizedCostFunction<1, 1, 1> {
 public:
  explicit Bearing(double distance) : distance_(distance) {}
  bool Evaluate(double const* const* x, double* residual, double** jacobian) const override {
    residual[0] = 400 * (x[0][0] / distance_ + x[1][0]);
    if (jacobian == nullptr) return true;
    if (jacobian[0] != nullptr) jacobian[0][0] = 400 / distance_;
    if (jacobian[1] != nullptr) jacobian[1][0] = 400;
    return true;
  }

 private:
  double distance_;
};

// A turn that a free landmark takes part in is not known, however far away the landmark is: of the
// 400^2 = 1.6e5 of its one image the marginal's damping, 1e-12, is left, and rounding.
TEST_F(ProblemBuilderTest, AFarLandmarkThatIsFreeTellsNoTurn) {
  for (const double distance : {1.0, 1e4, 1e9}) {
    double aside = 0, turn = 0, untouched = 0;
    ProblemBuilder problem(map_, {});
    problem.add_block(&aside, 1, ProblemBuilder::Group::kLandmarks);
    problem.add_block(&untouched, 1, ProblemBuilder::Group::kLandmarks);
    problem.add_block(&turn, 1, ProblemBuilder::Group::kLenses);
    Bearing seen(distance);
    Wish known(0);
    problem.add_factor(seen, nullptr, {&aside, &turn});
    EXPECT_NEAR(problem.marginal({ProblemBuilder::Group::kLenses}).information(0, 0), 0, 1e-6)
        << distance << " m";
    // What is known of it besides is known still.
    problem.add_factor(known, nullptr, {&turn});
    EXPECT_NEAR(problem.marginal({ProblemBuilder::Group::kLenses}).information(0, 0), 1, 1e-6)
        << distance << " m";
  }
}

TEST_F(ProblemBuilderTest, TheCostIsUnderTheLoss) {
  double held = 10;
  ProblemBuilder problem(map_, window_);
  problem.add_block(&held, 1, ProblemBuilder::Group::kLenses);
  problem.hold(&held);
  double free = 0;
  problem.add_block(&free, 1, ProblemBuilder::Group::kLenses);
  Wish zero(0);
  ceres::HuberLoss huber(1);
  problem.add_factor(zero, &huber, {&held});
  problem.add_factor(zero, nullptr, {&free});
  // Half of 2 * 10 - 1.
  EXPECT_NEAR(problem.solve(dense_qr()), 9.5, 1e-9);
}

}  // namespace
}  // namespace vinebench::slam
