// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/landmark_factors.h"

#include "slam/factors/robust_loss.h"
#include "slam/frame/measurements.h"

namespace vinebench::slam {

namespace {

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
      loss_(make_loss(rig.noise.loss)) {}

void LandmarkFactors::add_to(ProblemBuilder& problem, const Map& map) {
  landmark_ids_ = landmarks_of(problem.window().moved, map);
  if (min_keyframes_ > 1) {
    std::erase_if(landmark_ids_, [&](int id) {
      return count_taking_part(map.landmark(id), problem) < min_keyframes_;
    });
  }
  points_.reserve(landmark_ids_.size());
  for (const int id : landmark_ids_) add_landmark(map.landmark(id), map, problem);
}

void LandmarkFactors::add_landmark(const Landmark& landmark, const Map& map,
                                   ProblemBuilder& problem) {
  points_.push_back(landmark.position);
  double* point = points_.back().data();
  problem.add_block(point, 3, ProblemBuilder::Group::kLandmarks);
  for (const Observation& o : landmark.observations) {
    if (!problem.takes_part(o.keyframe)) continue;
    const auto v = static_cast<std::size_t>(o.view);
    const StereoView& view = map.keyframe(o.keyframe).frame->views[v];
    PixelMeasurement m = measure(view, o.feature, rig_.noise);
    m.velocity = map.keyframe(o.keyframe).frame->velocity;
    const auto& cameras = calibration_ != nullptr ? rig_.nominal_cameras : rig_.left_cameras;
    factors_.emplace_back(cameras[v], m, calibration_ != nullptr);
    std::vector<double*> blocks{problem.pose_of(o.keyframe), point};
    if (calibration_ != nullptr) {
      blocks.push_back(calibration_->camera(v));
      blocks.push_back(calibration_->lens(v));
    }
    problem.add_factor(factors_.back(), loss_.get(), blocks);
    terms_.push_back({points_.size() - 1, o, &factors_.back(), chi_squared_limit(m)});
  }
}

void LandmarkFactors::conclude(const std::vector<Pose>& T_map_bodies, const Map& map) {
  const auto T_map_body = [&](int keyframe) {
    return T_map_bodies[static_cast<std::size_t>(keyframe)];
  };
  auto term = terms_.begin();
  for (std::size_t i = 0; i < landmark_ids_.size(); ++i) {
    Landmark landmark = map.landmark(landmark_ids_[i]);
    landmark.position = points_[i];
    for (; term != terms_.end() && term->landmark == i; ++term) {
      const Observation& o = term->observation;
      if (term->factor->chi_squared(T_map_body(o.keyframe), points_[i]) <= term->limit) continue;
      std::erase(landmark.observations, o);
      outliers_.push_back({landmark.id, o});
    }
    looks_.push_back(map.look_of(landmark, T_map_body, rig_.T_body_cams));
  }
  terms_.clear();
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
