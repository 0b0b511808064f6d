// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/inertial_filter.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/geometry/cross_matrix.h"
#include "core/time.h"

namespace vinebench::slam {
namespace {

/// Of what is not known when a body is first seen: its velocity, and its acceleration, which is
/// taken for gravity.
constexpr double kFirstVelocity = 1;        // m/s
constexpr double kFirstAcceleration = 0.3;  // m/s^2

/// By which a map bends along the way, so that gravity turns in it.
constexpr double kGravityWalk = 2e-4;  // m/s^2/sqrt(s)

/// What a wheel's reading leaves open at any speed, and how a body heaves on its ground.
constexpr double kWheelNoise = 0.01;  // m/s
constexpr double kWheelArm = 0.3;     // m, from the body's centre, by which a turn rolls a wheel
constexpr double kHeave = 0.02;       // m/s
constexpr double kFirstCreep = 0.01;  // m/s

/// 99.9 % of chi-square with three degrees of freedom: beyond it wheels slip.
constexpr double kWheelGate = 16.27;

/// A gap between readings longer than this is not bridged by the reading after it.
constexpr double kLongestStep = 0.1;  // s

}  // namespace

void InertialFilter::begin(const Pose& T_map_body, const Matrix6d& covariance) {
  T_map_body_ = T_map_body;
  const Eigen::Matrix3d R = T_map_body.rotation.toRotationMatrix();
  const Eigen::Vector3d up = (R * last_reading_->specific_force).normalized();
  gravity_ = -kStandardGravity * up;
  covariance_.setZero();
  const auto diagonal = [&](int part, double sigma) {
    covariance_.diagonal().segment<3>(part).setConstant(sigma * sigma);
  };
  diagonal(kVelocity, kFirstVelocity);
  diagonal(kGyroscope, noise_.gyroscope.bias);
  diagonal(kAccelerometer, noise_.accelerometer.bias);
  const Eigen::Matrix3d along = up * up.transpose();
  covariance_.block<3, 3>(kGravity, kGravity) =
      std::pow(kFirstAcceleration, 2) * (Eigen::Matrix3d::Identity() - along) +
      std::pow(kGravitySpread, 2) * along;
  if (wheel_config_) {
    covariance_.diagonal().segment<2>(kWheels).setConstant(std::pow(wheel_config_->scale, 2));
    covariance_.diagonal().segment<2>(kWheels + 2).setConstant(std::pow(kFirstCreep, 2));
  }
  covariance_.block<3, 3>(kPosition, kPosition) =
      R * covariance.topLeftCorner<3, 3>() * R.transpose();
  covariance_.block<3, 3>(kRotation, kRotation) = covariance.bottomRightCorner<3, 3>();
  running_ = true;
}

void InertialFilter::advance(const std::vector<ImuSample>& readings,
                             const std::optional<WheelStep>& wheels, Stamp stamp) {
  if (stamp <= stamp_) return;
  const Pose before = T_map_body_;
  const double dt = to_seconds(stamp - stamp_);
  for (const ImuSample& reading : readings) {
    if (running_ && last_reading_ && reading.stamp > stamp_) {
      ImuSample mean = reading;
      mean.angular_velocity = (mean.angular_velocity + last_reading_->angular_velocity) / 2;
      mean.specific_force = (mean.specific_force + last_reading_->specific_force) / 2;
      integrate(mean, std::min(reading.stamp, stamp));
    }
    last_reading_ = reading;
  }
  if (running_ && last_reading_) integrate(*last_reading_, stamp);
  stamp_ = stamp;
  if (running_ && wheels && wheels->seconds > 0 && wheel_config_)
    believe_wheels(before, *wheels, dt);
}

/// From the filter's instant to that one, with the same reading all the way.
void InertialFilter::integrate(const ImuSample& reading, Stamp until) {
  const double dt = to_seconds(until - stamp_);
  if (dt <= 0) return;
  stamp_ = until;
  turn_rate_ = reading.angular_velocity - gyroscope_bias_;
  const Eigen::Vector3d force = reading.specific_force - accelerometer_bias_;
  motion_.add(turn_rate_, force, accelerometer_bias_, dt);
  motion_is_whole_ &= dt <= kLongestStep;
  const Eigen::Quaterniond half = T_map_body_.rotation * exp_so3(turn_rate_ * (dt / 2));
  const Eigen::Vector3d acceleration = half * force + gravity_;
  const Eigen::Matrix3d R = T_map_body_.rotation.toRotationMatrix();

  Eigen::MatrixXd F = Eigen::MatrixXd::Identity(kSize, kSize);
  F.block<3, 3>(kPosition, kVelocity).diagonal().setConstant(dt);
  F.block<3, 3>(kVelocity, kRotation) = -dt * R * cross_matrix(force);
  F.block<3, 3>(kVelocity, kAccelerometer) = -dt * R;
  F.block<3, 3>(kVelocity, kGravity).diagonal().setConstant(dt);
  F.block<3, 3>(kRotation, kRotation) = exp_so3(-dt * turn_rate_).toRotationMatrix();
  F.block<3, 3>(kRotation, kGyroscope).diagonal().setConstant(-dt);
  covariance_ = F * covariance_ * F.transpose();
  const auto grow = [&](int part, int size, double density) {
    covariance_.diagonal().segment(part, size).array() += density * density * dt;
  };
  // A gap in the readings: what happened in it is not known.
  const double doubt = dt > kLongestStep ? 100 : 1;
  grow(kVelocity, 3, doubt * noise_.accelerometer.noise_density);
  grow(kRotation, 3, doubt * noise_.gyroscope.noise_density);
  grow(kGyroscope, 3, noise_.gyroscope.bias_random_walk);
  grow(kAccelerometer, 3, noise_.accelerometer.bias_random_walk);
  grow(kGravity, 3, kGravityWalk);
  if (wheel_config_) {
    grow(kWheels, 2, wheel_config_->scale_walk);
    grow(kWheels + 2, 2, wheel_config_->creep_walk);
  }

  T_map_body_.translation += dt * velocity_ + (dt * dt / 2) * acceleration;
  velocity_ += dt * acceleration;
  T_map_body_.rotation = (T_map_body_.rotation * exp_so3(turn_rate_ * dt)).normalized();
}

/// The mean velocity since `before`, in its axes: the wheels' and what they slip by, and none
/// upwards. Far from what the inertial unit says they are not believed at all.
void InertialFilter::believe_wheels(const Pose& before, const WheelStep& wheels, double dt) {
  const Eigen::Matrix3d R = before.rotation.toRotationMatrix();
  const Eigen::Vector3d rolled = wheels.T_before_now.translation / wheels.seconds;
  const Eigen::Vector3d gone = R.transpose() * (T_map_body_.translation - before.translation) / dt;
  Eigen::Vector3d innovation = -gone;
  innovation.head<2>() +=
      rolled.head<2>().cwiseProduct((wheel_errors_.head<2>().array() + 1).matrix()) +
      wheel_errors_.tail<2>();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, kSize);
  H.block<3, 3>(0, kVelocity) = R.transpose();
  H.block<3, 3>(0, kRotation) = cross_matrix(gone);
  H.block<2, 2>(0, kWheels) = -Eigen::Vector2d(rolled.head<2>()).asDiagonal().toDenseMatrix();
  H.block<2, 2>(0, kWheels + 2) = -Eigen::Matrix2d::Identity();
  const double speed =
      rolled.norm() + kWheelArm * angle_of(wheels.T_before_now.rotation) / wheels.seconds;
  const double slip = std::hypot(kWheelNoise, wheel_config_->slip * speed);
  const Eigen::Vector3d sigma(slip, slip, kHeave);
  const Eigen::Matrix3d noise = sigma.cwiseAbs2().asDiagonal();
  const Eigen::Matrix3d expected = H * covariance_ * H.transpose() + noise;
  if (innovation.dot(expected.llt().solve(innovation)) > kWheelGate) return;
  update(innovation, H, noise);
}

void InertialFilter::see(const Pose& T_map_body, const Matrix6d& covariance) {
  if (!running_) {
    if (last_reading_) begin(T_map_body, covariance);
    return;
  }
  const Eigen::Matrix3d R = T_map_body_.rotation.toRotationMatrix();
  Vector6d innovation;
  innovation << T_map_body.translation - T_map_body_.translation,
      log_so3(T_map_body_.rotation.conjugate() * T_map_body.rotation);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6, kSize);
  H.block<3, 3>(0, kPosition).setIdentity();
  H.block<3, 3>(3, kRotation).setIdentity();
  Matrix6d to_map = Matrix6d::Identity();
  to_map.topLeftCorner<3, 3>() = R;
  update(innovation, H, to_map * covariance * to_map.transpose());
}

std::optional<PreintegratedMotion> InertialFilter::take_motion() {
  std::optional<PreintegratedMotion> taken;
  if (running_ && motion_is_whole_) taken = motion_;
  motion_ = {};
  motion_is_whole_ = true;
  return taken;
}

void InertialFilter::update(const Eigen::VectorXd& innovation, const Eigen::MatrixXd& H,
                            const Eigen::MatrixXd& noise) {
  const Eigen::MatrixXd S = H * covariance_ * H.transpose() + noise;
  const Eigen::MatrixXd K = S.llt().solve(H * covariance_).transpose();
  const Eigen::VectorXd step = K * innovation;
  const Eigen::MatrixXd kept = Eigen::MatrixXd::Identity(kSize, kSize) - K * H;
  covariance_ = kept * covariance_ * kept.transpose() + K * noise * K.transpose();
  T_map_body_.translation += step.segment<3>(kPosition);
  velocity_ += step.segment<3>(kVelocity);
  T_map_body_.rotation = (T_map_body_.rotation * exp_so3(step.segment<3>(kRotation))).normalized();
  gyroscope_bias_ += step.segment<3>(kGyroscope);
  accelerometer_bias_ += step.segment<3>(kAccelerometer);
  gravity_ += step.segment<3>(kGravity);
  wheel_errors_ += step.segment<4>(kWheels);
}

void InertialFilter::place(const Pose& T_map_body) {
  const Eigen::Quaterniond turn = T_map_body.rotation * T_map_body_.rotation.conjugate();
  velocity_ = turn * velocity_;
  T_map_body_ = T_map_body;
}

Vector6d InertialFilter::velocity() const {
  Vector6d velocity;
  velocity << T_map_body_.rotation.conjugate() * velocity_, turn_rate_;
  return velocity;
}

MapGravity InertialFilter::map_gravity() const {
  const auto part = [&](Part row, Part column) { return covariance_.block<3, 3>(row, column); };
  MapGravity known{gravity_, accelerometer_bias_};
  known.covariance << part(kGravity, kGravity), part(kGravity, kAccelerometer),
      part(kAccelerometer, kGravity), part(kAccelerometer, kAccelerometer);
  return known;
}

Matrix6d InertialFilter::covariance() const {
  const Eigen::Matrix3d R = T_map_body_.rotation.toRotationMatrix();
  Matrix6d covariance;
  covariance.topLeftCorner<3, 3>() =
      R.transpose() * covariance_.block<3, 3>(kPosition, kPosition) * R;
  covariance.topRightCorner<3, 3>() = R.transpose() * covariance_.block<3, 3>(kPosition, kRotation);
  covariance.bottomLeftCorner<3, 3>() = covariance.topRightCorner<3, 3>().transpose();
  covariance.bottomRightCorner<3, 3>() = covariance_.block<3, 3>(kRotation, kRotation);
  return covariance;
}

}  // namespace vinebench::slam
