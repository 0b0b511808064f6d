// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/gravity_factors.h"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "tests/support/swinging_body.h"
#include "tests/support/write_poses.h"

namespace vinebench::slam {
namespace {

using test::SwingingBody;

/// Twelve keyframes of a swinging body, 0.3 s apart.
class GravityFactorsTest : public testing::Test {
 protected:
  static constexpr int kKeyframes = 12;
  static constexpr double kInterval = 0.3;  // s

  GravityFactorsTest() {
    for (int k = 0; k < kKeyframes; ++k) {
      map_.add_keyframe(std::make_shared<FrameFeatures>(), truth(k), {});
      if (k > 0) map_.keyframe(k).motion = body_.motion((k - 1) * kInterval, k * kInterval);
    }
    map_.gravity() =
        MapGravity{body_.gravity, Eigen::Vector3d::Zero(), 1e-8 * Matrix6d::Identity()};
  }

  static Pose truth(int k) { return SwingingBody::pose(k * kInterval); }

  static AdjustmentWindow only_moves(int moved) {
    AdjustmentWindow window;
    for (int k = 0; k < kKeyframes; ++k) {
      if (k != moved) window.fixed.push_back(k);
    }
    window.moved = {moved};
    return window;
  }

  static AdjustmentWindow last_moves() { return only_moves(kKeyframes - 1); }

  /// Cost reached, keyframes written back.
  double adjusted(const AdjustmentWindow& window, const std::optional<InertialNoise>& inertial,
                  bool global = false, bool many = false) {
    ProblemBuilder problem(map_, window, many);
    GravityFactors factors(inertial, global);
    factors.add_to(problem, map_);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.function_tolerance = 1e-16;
    options.max_num_iterations = 100;
    options.logging_type = ceres::SILENT;
    const SchurOptions by_schur{.iterations = 300, .tolerance = 1e-15, .linear_tolerance = 1e-8};
    const double cost = many ? problem.solve(by_schur, false) : problem.solve(options);
    test::write_poses(problem, map_);
    factors.write_back(map_);
    return cost;
  }

  double tilt(int k) const {
    const Eigen::Vector3d down = map_.keyframe(k).T_map_body.rotation.conjugate() * body_.gravity;
    const Eigen::Vector3d truly = truth(k).rotation.conjugate() * body_.gravity;
    return std::acos(std::min(1.0, down.normalized().dot(truly.normalized())));
  }

  SwingingBody body_;
  Map map_{1.2};
};

// The last pose's place is determined by the two before it; its turn is not.
TEST_F(GravityFactorsTest, TheLastKeyframeComesToItsPlace) {
  map_.keyframe(kKeyframes - 1).T_map_body.translation += Eigen::Vector3d(0.02, -0.01, 0.03);
  EXPECT_NEAR(adjusted(last_moves(), InertialNoise{}), 0, 1e-3);
  const Pose last = map_.keyframe(kKeyframes - 1).T_map_body;
  // 3e-5 m/s^2 over 0.3 s squared: 3 um.
  EXPECT_NEAR((last.translation - truth(kKeyframes - 1).translation).norm(), 0, 1e-5);
}

// A keyframe in the middle that is tilted by half a degree, its place held by its neighbours':
// gravity turns it back. About the vertical nothing holds it but how the force turns with it.
TEST_F(GravityFactorsTest, AKeyframeIsTurnedUpright) {
  const int k = 5;
  const double half_degree = 0.5 * std::numbers::pi / 180;
  map_.keyframe(k).T_map_body.rotation =
      map_.keyframe(k).T_map_body.rotation * exp_so3({half_degree, 0, 0});
  EXPECT_GT(tilt(k), 0.9 * half_degree);  // its axis is nearly level
  EXPECT_NEAR(adjusted(only_moves(k), InertialNoise{}), 0, 1e-3);
  EXPECT_LT(tilt(k), 2e-5);  // rad: 3e-5 of 9.8 m/s^2, and the solver's end
}

// The same minimum of the same cost, in which gravity is a block of six numbers beside the poses.
// Where a step gains 1e-15 of it, what is left is far below a millionth of a deviation of 1e-2.
TEST_F(GravityFactorsTest, OfManyKeyframesGravityIsFoundLikewise) {
  const auto found = [&](bool many) {
    map_.gravity() = MapGravity{body_.gravity + Eigen::Vector3d(0.02, -0.03, 0.01),
                                Eigen::Vector3d::Zero(), 1e-8 * Matrix6d::Identity()};
    map_.keyframe(5).T_map_body = truth(5) * Pose{exp_so3({0.01, 0, 0}), {0.01, 0, 0}};
    adjusted(only_moves(5), InertialNoise{}, true, many);
    return std::pair{map_.gravity()->gravity, map_.keyframe(5).T_map_body};
  };
  const auto [gravity, pose] = found(false);
  const auto [of_many, pose_of_many] = found(true);
  EXPECT_LT((of_many - gravity).norm(), 1e-6);  // m/s^2
  EXPECT_LT((pose_of_many.translation - pose.translation).norm(), 1e-6);
  EXPECT_LT((gravity - body_.gravity).norm(), 0.03);  // moved from 0.037
}

// Three factors, of which one keyframe can please but half, say where gravity is. A local
// adjustment leaves it to the filter, and in a global one the world's vertical is believed.
TEST_F(GravityFactorsTest, AGlobalAdjustmentFindsGravity) {
  const Eigen::Vector3d off = body_.gravity + Eigen::Vector3d(0.02, -0.03, 0.01);  // m/s^2
  const auto found = [&](bool global, bool by_world) {
    map_.gravity() =
        MapGravity{off, Eigen::Vector3d::Zero(), 1e-8 * Matrix6d::Identity(), by_world};
    adjusted(only_moves(5), InertialNoise{}, global);
    return map_.gravity()->gravity;
  };
  EXPECT_EQ(found(false, false), off);
  // What is believed is 1e-2 m/s^2 wide, as is a factor.
  EXPECT_LT((found(true, false) - body_.gravity).norm(), 0.75 * (off - body_.gravity).norm());
  // 1e-4 m/s^2 against three factors of 1e-2 and 0.037 m/s^2: 3e-4 of that.
  EXPECT_LT((found(true, true) - off).norm(), 1.2e-5);
}

TEST_F(GravityFactorsTest, WithoutAUnitOrGravityThereIsNoFactor) {
  const Pose off{Eigen::Quaterniond::Identity(), {1, 2, 3}};
  map_.keyframe(kKeyframes - 1).T_map_body = off;
  adjusted(last_moves(), std::nullopt);
  EXPECT_EQ(map_.keyframe(kKeyframes - 1).T_map_body.translation, off.translation);
  map_.gravity().reset();
  adjusted(last_moves(), InertialNoise{});
  EXPECT_EQ(map_.keyframe(kKeyframes - 1).T_map_body.translation, off.translation);
}

TEST_F(GravityFactorsTest, AnIntervalThatIsMissingOrLongIsLeftOut) {
  const Pose off{Eigen::Quaterniond::Identity(), {1, 2, 3}};
  map_.keyframe(kKeyframes - 1).T_map_body = off;
  map_.keyframe(kKeyframes - 1).motion->seconds = 2.1;
  adjusted(last_moves(), InertialNoise{});
  EXPECT_EQ(map_.keyframe(kKeyframes - 1).T_map_body.translation, off.translation);
  map_.keyframe(kKeyframes - 1).motion.reset();
  adjusted(last_moves(), InertialNoise{});
  EXPECT_EQ(map_.keyframe(kKeyframes - 1).T_map_body.translation, off.translation);
}

}  // namespace
}  // namespace vinebench::slam
