// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/landmark_factors.h"

#include <cmath>
#include <utility>

#include "slam/frame/measurements.h"

namespace vinebench::slam {

namespace {

/// Images, or rows of them, that are less late are where any velocity has them.
constexpr double kLate = 1e-3;  // s

bool has_late_images(const FrameFeatures& frame, const EstimatorRig& rig) {
  for (std::size_t v = 0; v < frame.views.size(); ++v) {
    const StereoCameraModel& camera = rig.left_cameras[v];
    for (const double row : {0.0, static_cast<double>(camera.lens.height)}) {
      if (std::abs(frame.views[v].late + camera.time_of(row)) >= kLate) return true;
    }
  }
  return false;
}

std::unique_ptr<ceres::LossFunction> make_loss(ResidualLoss kind) {
  if (kind == ResidualLoss::kHuber) return std::make_unique<ceres::HuberLoss>(kHuberScale);
  return std::make_unique<ceres::CauchyLoss>(kCauchyScale);
}

/// Landmarks that these keyframes see, ascending.
std::vector<int> landmarks_of(const std::vector<int>& keyframes, const Map& map) {
  std::vector<char> seen(map.landmarks().size(), 0);
  for (const int id : keyframes) {
    for (const std::vector<int>& view : map.keyframe(id).landmarks) {
      for (const int landmark : view) {
        if (landmark >= 0) seen[static_cast<std::size_t>(landmark)] = 1;
      }
    }
  }
  std::vector<int> ids;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i]) ids.push_back(static_cast<int>(i));
  }
  return ids;
}

/// Number of the problem's keyframes that see a landmark.
int count_taking_part(const Landmark& landmark, const ProblemBuilder& problem) {
  int count = 0;
  int last = -1;
  for (const Observation& o : landmark.observations) {
    if (o.keyframe != last && problem.takes_part(o.keyframe)) ++count;
    last = o.keyframe;
  }
  return count;
}

}  // namespace

LandmarkFactors::LandmarkFactors(const EstimatorRig& rig, int min_keyframes,
                                 CalibrationUnknowns* calibration)
    : rig_(rig),
      min_keyframes_(min_keyframes),
      calibration_(calibration),
      loss_(make_loss(rig.noise.loss)),
      weights_(residual_loss(rig.noise.loss)) {}

void LandmarkFactors::add_to(ProblemBuilder& problem, const Map& map) {
  for (const Keyframe& keyframe : map.keyframes()) {
    frames_.push_back(problem.takes_part(keyframe.id) ? keyframe.frame : nullptr);
  }
  landmark_ids_ = landmarks_of(problem.window().moved, map);
  if (min_keyframes_ > 1) {
    std::erase_if(landmark_ids_, [&](int id) {
      return count_taking_part(map.landmark(id), problem) < min_keyframes_;
    });
  }
  points_.reserve(landmark_ids_.size());
  for (const int id : landmark_ids_) {
    const auto place = static_cast<std::uint32_t>(points_.size());
    points_.push_back(map.landmark(id).position);
    for (const Observation& o : map.landmark(id).observations) {
      if (problem.takes_part(o.keyframe)) seen_.push_back({place, o});
    }
  }
  if (problem.of_many()) {
    add_sights(problem);
  } else {
    add_factors(problem);
  }
}

PixelMeasurement LandmarkFactors::measurement(const Observation& o) const {
  const FrameFeatures& frame = *frames_[static_cast<std::size_t>(o.keyframe)];
  PixelMeasurement m =
      measure(frame.views[static_cast<std::size_t>(o.view)], o.feature, rig_.noise);
  m.velocity = frame.velocity;
  if (!velocity_blocks_.empty()) {
    const double* found = velocity_blocks_[static_cast<std::size_t>(o.keyframe)];
    if (found != nullptr) m.velocity = Eigen::Map<const Vector6d>(found);
  }
  return m;
}

const StereoCameraModel& LandmarkFactors::camera(const Observation& o) const {
  const auto& cameras = calibration_ != nullptr ? rig_.nominal_cameras : rig_.left_cameras;
  return cameras[static_cast<std::size_t>(o.view)];
}

void LandmarkFactors::add_factors(ProblemBuilder& problem) {
  for (Eigen::Vector3d& point : points_) {
    problem.add_block(point.data(), 3, ProblemBuilder::Group::kLandmarks);
  }
  add_velocities(problem);
  for (const auto& [place, o] : seen_) {
    std::vector<double*> blocks{problem.pose_of(o.keyframe), points_[place].data()};
    if (calibration_ != nullptr) {
      const auto v = static_cast<std::size_t>(o.view);
      blocks.push_back(calibration_->camera(v));
      blocks.push_back(calibration_->lens(v));
    }
    double* velocity = velocity_blocks_[static_cast<std::size_t>(o.keyframe)];
    if (velocity != nullptr) blocks.push_back(velocity);
    factors_.emplace_back(
        camera(o), measurement(o),
        ReprojectionFactor::Unknown{calibration_ != nullptr, velocity != nullptr});
    problem.add_factor(factors_.back(), loss_.get(), blocks);
  }
}

/// Of the keyframes with late images, and of all where the calibration is unknown, which may find
/// them late: what the velocity has wrong would be taken for an error of the calibration.
void LandmarkFactors::add_velocities(ProblemBuilder& problem) {
  velocity_blocks_.assign(frames_.size(), nullptr);
  velocities_.reserve(frames_.size());  // nothing moves any more once it is handed out
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    if (!frames_[k]) continue;
    if (calibration_ == nullptr && !has_late_images(*frames_[k], rig_)) continue;
    double* block = velocities_.emplace_back(frames_[k]->velocity).data();
    velocity_blocks_[k] = block;
    problem.add_block(block, 6, ProblemBuilder::Group::kVelocities);
    const Vector6d weight = error_of_velocity().cwiseInverse();
    velocity_beliefs_.emplace_back(weight.asDiagonal().toDenseMatrix(), velocities_.back());
    problem.add_factor(velocity_beliefs_.back(), nullptr, {block});
  }
}

void LandmarkFactors::add_sights(ProblemBuilder& problem) {
  std::vector<double*> points;
  points.reserve(points_.size());
  for (Eigen::Vector3d& point : points_) points.push_back(point.data());
  std::vector<Sight> sights;
  sights.reserve(seen_.size());
  for (const auto& [place, o] : seen_) {
    sights.push_back({place, static_cast<std::uint32_t>(problem.place_of(o.keyframe))});
  }
  problem.set_sights(*this, std::move(points), std::move(sights));
}

double LandmarkFactors::cost(std::size_t sight, const Pose& T_map_body,
                             const Eigen::Vector3d& p_map) const {
  const Observation& o = seen_[sight].observation;
  const Reprojection reprojection(camera(o), measurement(o));
  return weights_.cost(reprojection.residual(T_map_body, p_map).squaredNorm()) / 2;
}

Sights::Linearised LandmarkFactors::linearise(std::size_t sight, const Pose& T_map_body,
                                              const Eigen::Vector3d& p_map) const {
  const Observation& o = seen_[sight].observation;
  const auto at = Reprojection(camera(o), measurement(o)).linearise(T_map_body, p_map);
  const double scale = std::sqrt(weights_.weight(at.residual.squaredNorm()));
  const Eigen::Matrix3d R_body_map = T_map_body.rotation.toRotationMatrix().transpose();
  return {scale * at.residual, scale * at.by_pose, scale * at.by_point_in_body * R_body_map};
}

void LandmarkFactors::conclude(const std::vector<Pose>& T_map_bodies, const Map& map) {
  auto seen = seen_.begin();
  for (std::size_t i = 0; i < landmark_ids_.size(); ++i) {
    Landmark landmark = map.landmark(landmark_ids_[i]);
    landmark.position = points_[i];
    for (; seen != seen_.end() && seen->landmark == i; ++seen) {
      const Observation& o = seen->observation;
      const PixelMeasurement m = measurement(o);
      const Pose& T_map_body = T_map_bodies[static_cast<std::size_t>(o.keyframe)];
      const double chi_squared = Reprojection(camera(o), m).chi_squared(T_map_body, points_[i]);
      if (chi_squared <= chi_squared_limit(m)) continue;
      std::erase(landmark.observations, o);
      outliers_.push_back({landmark.id, o});
    }
    const auto T_map_body_of = [&](int keyframe) {
      return T_map_bodies[static_cast<std::size_t>(keyframe)];
    };
    looks_.push_back(map.look_of(landmark, T_map_body_of, rig_.T_body_cams));
  }
  seen_.clear();
  factors_.clear();
}

void LandmarkFactors::write_back(Map& map) const {
  for (std::size_t i = 0; i < landmark_ids_.size(); ++i) {
    Landmark& landmark = map.landmark(landmark_ids_[i]);
    landmark.position = points_[i];
    static_cast<LandmarkLook&>(landmark) = looks_[i];
  }
  for (const Outlier& o : outliers_) map.remove_observation(o.landmark, o.observation);
}

}  // namespace vinebench::slam
