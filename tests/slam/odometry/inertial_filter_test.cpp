// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/inertial_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "core/util/random.h"

namespace vinebench::slam {
namespace {

constexpr Stamp kReadingPeriod = kNanosecondsPerSecond / 200;
constexpr Stamp kFramePeriod = kNanosecondsPerSecond / 20;
constexpr double kGravity = 9.80665;  // m/s^2

/// A body that weaves, heaves and tilts a little, as one does on rough ground.
Pose pose_at(double t) {
  return {
      from_roll_pitch_yaw({0.05 * std::sin(t), 0.04 * std::sin(0.8 * t), 0.5 * std::sin(0.4 * t)}),
      {1.5 * std::sin(0.3 * t), 1 - std::cos(0.3 * t), 0.005 * std::sin(0.9 * t)}};
}

Eigen::Vector3d velocity_at(double t) {
  constexpr double kStep = 1e-4;
  return (pose_at(t + kStep).translation - pose_at(t - kStep).translation) / (2 * kStep);
}

struct Errors {
  Eigen::Vector3d gyroscope_bias = Eigen::Vector3d::Zero();
  Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Zero();
  double scale = 0;     ///< by which the body goes farther than its wheels say
  InertialNoise noise;  ///< of the unit, where there is some
  bool noisy = false;
  std::uint64_t seed = 1;
};

/// What a body of pose_at() reads and sees.
class Drive {
 public:
  explicit Drive(const Errors& errors) : errors_(errors) {}

  /// Frames until then; cameras see unless `blind`.
  void go(InertialFilter& filter, double seconds, bool blind = false, bool wheels = false,
          bool spinning = false) {
    while (to_seconds(now_) < seconds - 1e-9) {
      const Pose before = pose_at(to_seconds(now_));
      const Stamp next = now_ + kFramePeriod;
      std::vector<ImuSample> readings;
      for (Stamp t = now_ + kReadingPeriod; t <= next; t += kReadingPeriod) {
        readings.push_back(reading(t));
      }
      now_ = next;
      std::optional<WheelStep> rolled;
      if (wheels) {
        rolled = WheelStep{before.inverse() * pose_at(to_seconds(now_)), to_seconds(kFramePeriod)};
        rolled->T_before_now.translation.z() = 0;
        rolled->T_before_now.translation /= 1 + errors_.scale;
        if (spinning) rolled->T_before_now.translation.x() += 0.1;
      }
      filter.advance(readings, rolled, now_);
      if (!blind) filter.see(seen(), kSeenSigma * kSeenSigma * Matrix6d::Identity());
    }
  }

  Pose truth() const { return pose_at(to_seconds(now_)); }

  static constexpr double kSeenSigma = 5e-4;  // m and rad

 private:
  Eigen::Vector3d draw() {
    const Eigen::Vector3d v(stream_.normal(index_), stream_.normal(index_ + 1),
                            stream_.normal(index_ + 2));
    index_ += 3;
    return v;
  }

  ImuSample reading(Stamp stamp) {
    constexpr double kStep = 1e-3;
    const double t = to_seconds(stamp);
    const Pose T = pose_at(t);
    const Eigen::Vector3d acceleration =
        (velocity_at(t + kStep) - velocity_at(t - kStep)) / (2 * kStep);
    ImuSample sample;
    sample.stamp = stamp;
    sample.angular_velocity =
        log_so3(pose_at(t - kStep).rotation.conjugate() * pose_at(t + kStep).rotation) /
            (2 * kStep) +
        errors_.gyroscope_bias;
    sample.specific_force =
        T.rotation.conjugate() * (acceleration + Eigen::Vector3d(0, 0, kGravity)) +
        errors_.accelerometer_bias;
    if (errors_.noisy) {
      const double root = std::sqrt(1 / to_seconds(kReadingPeriod));
      sample.angular_velocity += errors_.noise.gyroscope.noise_density * root * draw();
      sample.specific_force += errors_.noise.accelerometer.noise_density * root * draw();
    }
    return sample;
  }

  Pose seen() {
    if (!errors_.noisy) return truth();
    Vector6d step;
    step << draw(), draw();
    return truth() * step_of(kSeenSigma * step);
  }

  Errors errors_;
  Stamp now_ = 0;
  RandomStream stream_{errors_.seed, "inertial filter test"};
  std::uint64_t index_ = 0;
};

/// In the plane alone: this body tilts without what it stands on, so that its wheels' plane does
/// not say how high it is.
double off_in_plane(const Drive& drive, const InertialFilter& filter) {
  return (drive.truth().translation - filter.T_map_body().translation).head<2>().norm();
}

double off(const Drive& drive, const InertialFilter& filter) {
  return (drive.truth().translation - filter.T_map_body().translation).norm();
}

TEST(InertialFilterTest, WaitsForReadingsAndForAPose) {
  InertialFilter filter{InertialNoise{}, {}};
  filter.see(Pose{}, Matrix6d::Identity());
  EXPECT_FALSE(filter.running());
  filter.advance({{kReadingPeriod, Eigen::Vector3d::Zero(), {0, 0, kGravity}}}, {}, kFramePeriod);
  EXPECT_FALSE(filter.running());
  filter.see(Pose{}, Matrix6d::Identity());
  EXPECT_TRUE(filter.running());
}

TEST(InertialFilterTest, GoesOnWhereCamerasSeeNothing) {
  InertialFilter filter{InertialNoise{}, {}};
  Drive drive{Errors{}};
  drive.go(filter, 20);
  EXPECT_LT(
      (filter.velocity().head<3>() - drive.truth().rotation.conjugate() * velocity_at(20)).norm(),
      2e-3);
  drive.go(filter, 25, true);
  // An exact unit, whose biases are known to 3e-4 m/s^2 of the 5e-2 that they may be: half of that
  // times 25 s^2.
  EXPECT_LT(off(drive, filter), 4e-3);  // m
  EXPECT_LT(angle_of(drive.truth().rotation.conjugate() * filter.T_map_body().rotation), 1e-3);
}

TEST(InertialFilterTest, FindsBiasesAndGravity) {
  Errors errors;
  errors.gyroscope_bias = {3e-3, -2e-3, 4e-3};
  errors.accelerometer_bias = {0.03, -0.04, 0.02};
  InertialFilter filter{InertialNoise{}, {}};
  Drive drive{errors};
  drive.go(filter, 60);
  // 4e-4 rad/s/sqrt(Hz) of noise over a minute, and a walk of the bias of about as much.
  EXPECT_LT((filter.gyroscope_bias() - errors.gyroscope_bias).norm(), 2e-4);
  // A bias is told from gravity by turning: half a radian to either side.
  EXPECT_LT((filter.accelerometer_bias() - errors.accelerometer_bias).head<2>().norm(), 8e-3);
  EXPECT_LT((filter.gravity() - Eigen::Vector3d(0, 0, -kGravity)).head<2>().norm(), 8e-3);
}

TEST(InertialFilterTest, KnowsHowFarItIsOff) {
  constexpr int kDrives = 30;
  double sum = 0;
  for (int i = 0; i < kDrives; ++i) {
    Errors errors;
    errors.noisy = true;
    errors.seed = static_cast<std::uint64_t>(i + 1);
    RandomStream biases(errors.seed, "inertial filter test's biases");
    for (int axis = 0; axis < 3; ++axis) {
      const auto n = static_cast<std::uint64_t>(axis);
      errors.gyroscope_bias[axis] = errors.noise.gyroscope.bias * biases.normal(n);
      errors.accelerometer_bias[axis] = errors.noise.accelerometer.bias * biases.normal(n + 3);
    }
    InertialFilter filter{errors.noise, {}};
    Drive drive{errors};
    drive.go(filter, 15);
    drive.go(filter, 18, true);
    Vector6d error;
    error << filter.T_map_body().rotation.conjugate() *
                 (drive.truth().translation - filter.T_map_body().translation),
        log_so3(filter.T_map_body().rotation.conjugate() * drive.truth().rotation);
    sum += error.dot(filter.covariance().llt().solve(error));
  }
  // Six degrees of freedom in each of 30 drives: 180 with a deviation of sqrt(360) = 19. The filter
  // also allows for walks of biases and gravity that these drives do not have.
  EXPECT_LT(sum, 180 + 3 * 19);
  EXPECT_GT(sum, 180 / 3);
}

TEST(InertialFilterTest, LearnsWhatWheelsSlipAndGoesByThem) {
  Errors errors;
  errors.noisy = true;
  errors.scale = 0.03;
  InertialFilter alone{errors.noise, {}};
  InertialFilter with_wheels{errors.noise, WheelFusionConfig{}};
  Drive drive{errors};
  Drive same{errors};
  drive.go(alone, 30);
  same.go(with_wheels, 30, false, true);
  EXPECT_NEAR(with_wheels.wheel_scale().x(), 0.03, 0.005);
  drive.go(alone, 40, true);
  same.go(with_wheels, 40, true, true);
  EXPECT_LT(off_in_plane(same, with_wheels), 0.03);  // m, over 4 m: creep of 1 mm/s and more
  EXPECT_LT(off_in_plane(same, with_wheels), off_in_plane(drive, alone) / 2);
}

TEST(InertialFilterTest, DoesNotBelieveWheelsThatSpin) {
  Errors errors;
  InertialFilter filter{errors.noise, WheelFusionConfig{}};
  Drive drive{errors};
  drive.go(filter, 20, false, true);
  drive.go(filter, 21, true, true, true);  // 2 m/s too fast for a second
  EXPECT_LT(off(drive, filter), 0.01);     // m
}

// Its pose is corrected by what turns and shifts it in the map: seen from itself it moves as
// before, and gravity lies in the map as it did.
TEST(InertialFilterTest, SetDownElsewhereItMovesOn) {
  const Pose T_new_old{from_roll_pitch_yaw({0.02, -0.03, 1.2}), {3, -2, 0.5}};
  InertialFilter filter{InertialNoise{}, {}};
  Drive drive{Errors{}};
  drive.go(filter, 10, false, true);
  const Vector6d velocity = filter.velocity();
  const Eigen::Vector3d gravity = filter.gravity();
  const Pose T_map_body = T_new_old * filter.T_map_body();
  filter.place(T_map_body);
  EXPECT_EQ(filter.T_map_body().translation, T_map_body.translation);
  EXPECT_LT((filter.velocity() - velocity).norm(), 1e-12);
  EXPECT_EQ(filter.gravity(), gravity);
}

// p1 = p0 + v0 t + g t^2 / 2 + R0 a: what was measured takes the body from where it was to where it
// is. Readings 5 ms apart and biases learned from seen poses leave less than a millimetre in 0.4 s.
TEST(InertialFilterTest, SaysWhatWasMeasuredBetweenTwoCalls) {
  Errors errors;
  errors.accelerometer_bias = {0.03, -0.02, 0.01};
  InertialFilter filter{InertialNoise{}, {}};
  Drive drive{errors};
  EXPECT_FALSE(filter.take_motion());  // it does not run yet
  drive.go(filter, 30);
  filter.take_motion();
  drive.go(filter, 30.4);
  const std::optional<PreintegratedMotion> motion = filter.take_motion();
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->seconds, 0.4, 1e-9);
  const Pose before = pose_at(30);
  const Eigen::Vector3d after = before.translation + 0.4 * velocity_at(30) +
                                0.08 * Eigen::Vector3d(0, 0, -kGravity) +
                                before.rotation * motion->position;
  EXPECT_LT((after - drive.truth().translation).norm(), 1e-3);
  EXPECT_LT(angle_of(motion->turn.conjugate() * (before.inverse() * drive.truth()).rotation), 1e-3);
  EXPECT_LT((motion->accelerometer_bias - filter.accelerometer_bias()).norm(), 2e-3);  // m/s^2
}

TEST(InertialFilterTest, AMotionWithoutReadingsIsNoneAndTheNextIsOne) {
  InertialFilter filter{InertialNoise{}, {}};
  Drive drive{Errors{}};
  drive.go(filter, 1);
  InertialFilter gap = filter;
  gap.advance({}, {}, 2 * kNanosecondsPerSecond);
  EXPECT_FALSE(gap.take_motion());
  gap.advance({{5 * kNanosecondsPerSecond / 2, {0, 0, 0}, {0, 0, kGravity}}}, {},
              2 * kNanosecondsPerSecond + kFramePeriod);
  EXPECT_TRUE(gap.take_motion());
}

// A body that stands feels gravity and its bias together: their difference, by g - R b, is known
// far better than either.
TEST(InertialFilterTest, StandingItKnowsGravityTogetherWithTheBiasAlone) {
  InertialFilter filter{InertialNoise{}, {}};
  const Matrix6d seen = 1e-7 * Matrix6d::Identity();
  Stamp stamp = 0;
  for (int i = 0; i < 60; ++i) {
    stamp += kFramePeriod;
    filter.advance({{stamp, {0, 0, 0}, {0.02, 0, kGravity}}}, {}, stamp);
    filter.see(Pose{}, seen);
  }
  const MapGravity known = filter.map_gravity();
  EXPECT_EQ(known.gravity, filter.gravity());
  Eigen::Matrix<double, 6, 1> together = Vector6d::Zero();
  together << 1, 0, 0, -1, 0, 0;
  EXPECT_LT(together.dot(known.covariance * together), 0.1 * known.covariance(0, 0));
  EXPECT_LT(together.dot(known.covariance * together), 0.1 * known.covariance(3, 3));
  EXPECT_GT(known.covariance(0, 0), std::pow(0.03, 2));  // m/s^2: of a bias of 0.05
}

TEST(InertialFilterTest, AFrameCountsOnce) {
  InertialFilter filter{InertialNoise{}, {}};
  Drive drive{Errors{}};
  drive.go(filter, 1);
  const Pose before = filter.T_map_body();
  filter.advance({{kNanosecondsPerSecond, {1, 1, 1}, {5, 5, 5}}}, {}, kNanosecondsPerSecond);
  EXPECT_EQ(filter.T_map_body().translation, before.translation);
}

}  // namespace
}  // namespace vinebench::slam
