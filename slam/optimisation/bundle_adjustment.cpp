// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/bundle_adjustment.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "slam/optimisation/tag_localisation.h"

namespace vinebench::slam {
namespace {

constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);

/// Relative decrease of the cost at which a global adjustment is done.
constexpr double kGlobalTolerance = 1e-5;

/// Beyond so many keyframes the normal equations of their poses are solved by conjugate gradients:
/// what is far away is seen from everywhere, so that they have no zeros to speak of, and to factor
/// them takes the cube of their number.
constexpr std::size_t kManyKeyframes = 400;

/// Relative decrease of the cost at which such an adjustment is done.
constexpr double kManyKeyframesTolerance = 5e-4;

/// Steps of conjugate gradients at most: they smooth what is near each other, and what is far apart
/// was put right when the loop's correction was spread.
constexpr int kManyKeyframesSteps = 60;

}  // namespace

/// One Ceres problem over a window of the map. Blocks are kept by position in ascending id, so that
/// the problem is built in the same order every time.
class AdjustmentJob::Impl {
 public:
  Impl(AdjustmentWindow window, const EstimatorRig& rig, const AdjustmentOptions& options)
      : window_(std::move(window)), rig_(rig), options_(options), problem_(ownership()) {
    for (const StereoCameraModel& camera : rig.left_cameras)
      offsets_.push_back(camera.disparity_offset);
    offset_used_.assign(offsets_.size(), 0);
  }

  void build(const Map& map) {
    add_keyframes(map);
    add_landmarks(map);
    for (const int id : window_.moved) add_link(map.keyframe(id));
    for (const int id : window_.moved) add_tags(id, map);
    for (const int id : window_.fixed) add_tags(id, map);
  }

  double solve() {
    const bool many = window_.moved.size() > kManyKeyframes;
    ceres::Solver::Options options;
    options.linear_solver_type = many ? ceres::ITERATIVE_SCHUR : ceres::DENSE_SCHUR;
    options.preconditioner_type = ceres::SCHUR_JACOBI;
    options.dense_linear_algebra_library_type = ceres::EIGEN;
    options.max_linear_solver_iterations = kManyKeyframesSteps;
    options.max_num_iterations = options_.iterations;
    options.function_tolerance = many              ? kManyKeyframesTolerance
                                 : options_.global ? kGlobalTolerance
                                                   : 1e-6;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>(ordering_);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.final_cost;
  }

  void free_offsets() {
    for (std::size_t v = 0; v < offsets_.size(); ++v) {
      if (offset_used_[v]) problem_.SetParameterBlockVariable(&offsets_[v]);
    }
  }

  const std::vector<double>& disparity_offsets() const { return offsets_; }

  void write_back(Map& map) {
    for (const int id : window_.moved) {
      map.keyframe(id).T_map_body = from_block(pose_of(id));
    }
    for (std::size_t i = 0; i < landmark_ids_.size(); ++i) {
      map.landmark(landmark_ids_[i]).position = points_[i];
    }
    for (std::size_t t = 0; t < tag_blocks_.size(); ++t) {
      if (tag_used_[t]) map.tags()[t].T_map_tag = from_block(tag_blocks_[t].data());
    }
  }

  void remove_outliers(Map& map) {
    for (const Term& term : terms_) {
      const Keyframe& keyframe = map.keyframe(term.observation.keyframe);
      const double chi_squared =
          term.error->chi_squared(keyframe.T_map_body, map.landmark(term.landmark).position);
      if (chi_squared > term.limit) map.remove_observation(term.landmark, term.observation);
    }
    for (const int id : landmark_ids_) map.refresh(id, rig_.T_body_cams);
  }

 private:
  struct Term {
    int landmark;
    Observation observation;
    const ReprojectionError* error;
    double limit;
  };

  static ceres::Problem::Options ownership() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    return options;
  }

  bool takes_part(int keyframe) const {
    return pose_index_[static_cast<std::size_t>(keyframe)] != kAbsent;
  }

  double* pose_of(int keyframe) {
    return poses_[pose_index_[static_cast<std::size_t>(keyframe)]].data();
  }

  void add_keyframes(const Map& map) {
    pose_index_.assign(map.keyframes().size(), kAbsent);
    poses_.reserve(window_.moved.size() + window_.fixed.size());
    const auto add = [&](int id, bool fixed) {
      pose_index_[static_cast<std::size_t>(id)] = poses_.size();
      poses_.push_back(to_block(map.keyframe(id).T_map_body));
      problem_.AddParameterBlock(poses_.back().data(), 7, &manifold_);
      ordering_.AddElementToGroup(poses_.back().data(), 1);
      if (fixed) problem_.SetParameterBlockConstant(poses_.back().data());
    };
    for (const int id : window_.moved) add(id, false);
    for (const int id : window_.fixed) add(id, true);
  }

  void add_landmarks(const Map& map) {
    std::vector<char> seen(map.landmarks().size(), 0);
    for (const int id : window_.moved) {
      for (const std::vector<int>& view : map.keyframe(id).landmarks) {
        for (const int landmark : view) {
          if (landmark >= 0) seen[static_cast<std::size_t>(landmark)] = 1;
        }
      }
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (seen[i]) landmark_ids_.push_back(static_cast<int>(i));
    }
    points_.reserve(landmark_ids_.size());
    for (const int id : landmark_ids_) add_landmark(map.landmark(id), map);
  }

  void add_landmark(const Landmark& landmark, const Map& map) {
    points_.push_back(landmark.position);
    double* point = points_.back().data();
    problem_.AddParameterBlock(point, 3);
    ordering_.AddElementToGroup(point, 0);
    for (const Observation& o : landmark.observations) {
      if (!takes_part(o.keyframe)) continue;
      const StereoView& view =
          map.keyframe(o.keyframe).frame->views[static_cast<std::size_t>(o.view)];
      const PixelMeasurement m = rig_.measurement(view, o.feature);
      const bool with_offset = options_.offsets_unknown && m.right_x;
      errors_.emplace_back(rig_.left_cameras[static_cast<std::size_t>(o.view)], m, with_offset);
      std::vector<double*> blocks{pose_of(o.keyframe), point};
      if (with_offset) blocks.push_back(offset_of(static_cast<std::size_t>(o.view)));
      problem_.AddResidualBlock(&errors_.back(), &cauchy_, blocks);
      terms_.push_back({landmark.id, o, &errors_.back(), chi_squared_limit(m)});
    }
  }

  double* offset_of(std::size_t camera) {
    double* offset = &offsets_[camera];
    if (!offset_used_[camera]) {
      problem_.AddParameterBlock(offset, 1);
      ordering_.AddElementToGroup(offset, 1);
      problem_.SetParameterBlockConstant(offset);
      offset_used_[camera] = 1;
    }
    return offset;
  }

  /// Ties a keyframe to the one before a odometry gap, where both take part.
  void add_link(const Keyframe& keyframe) {
    if (!keyframe.link || !takes_part(keyframe.link->from)) return;
    odometry_errors_.emplace_back(keyframe.link->T_from_to, keyframe.link->covariance);
    problem_.AddResidualBlock(&odometry_errors_.back(), nullptr, pose_of(keyframe.link->from),
                              pose_of(keyframe.id));
  }

  void add_tags(int keyframe, const Map& map) {
    if (tag_blocks_.empty()) {
      for (const MapTag& tag : map.tags()) tag_blocks_.push_back(to_block(tag.T_map_tag));
      tag_used_.assign(tag_blocks_.size(), 0);
    }
    for (const TagSighting& sighting : map.keyframe(keyframe).frame->tags) {
      const MapTag* tag = map.find_tag(sighting.family, sighting.id);
      if (tag == nullptr) continue;
      const auto t = static_cast<std::size_t>(tag - map.tags().data());
      double* block = tag_blocks_[t].data();
      if (!tag_used_[t]) {
        problem_.AddParameterBlock(block, 7, &manifold_);
        ordering_.AddElementToGroup(block, 1);
        if (tag->fixed || !options_.global) problem_.SetParameterBlockConstant(block);
        tag_used_[t] = 1;
      }
      const std::array<Eigen::Vector3d, 4> corners = tag_corners(tag->size);
      const double sigma = corner_sigma(sighting, options_.tag_corner_sigma);
      const StereoCameraModel& camera =
          rig_.undistorted_cameras[static_cast<std::size_t>(sighting.camera)];
      for (std::size_t c = 0; c < corners.size(); ++c) {
        tag_errors_.emplace_back(camera, ideal_corner(sighting, c, rig_), sigma, corners[c]);
        problem_.AddResidualBlock(&tag_errors_.back(), &huber_, pose_of(keyframe), block);
      }
    }
  }

  AdjustmentWindow window_;
  const EstimatorRig& rig_;
  AdjustmentOptions options_;
  PoseManifold manifold_;
  ceres::CauchyLoss cauchy_{kCauchyScale};
  ceres::HuberLoss huber_{std::sqrt(kChiSquared2)};  ///< of tags
  std::vector<PoseBlock> poses_;
  std::vector<std::size_t> pose_index_;  ///< by keyframe id
  std::vector<int> landmark_ids_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<PoseBlock> tag_blocks_;
  std::vector<char> tag_used_;
  std::deque<ReprojectionError> errors_;
  std::deque<TagCornerError> tag_errors_;
  std::deque<OdometryError> odometry_errors_;
  std::vector<Term> terms_;
  std::vector<double> offsets_;  ///< px, of each camera
  std::vector<char> offset_used_;
  ceres::ParameterBlockOrdering ordering_;
  ceres::Problem problem_;  // last: it must go before the blocks it points to
};

AdjustmentJob::AdjustmentJob(const Map& map, AdjustmentWindow window, const EstimatorRig& rig,
                             const AdjustmentOptions& options)
    : impl_(std::make_unique<Impl>(std::move(window), rig, options)) {
  impl_->build(map);
}

AdjustmentJob::~AdjustmentJob() = default;

double AdjustmentJob::solve() {
  return impl_->solve();
}

void AdjustmentJob::free_offsets() {
  impl_->free_offsets();
}

const std::vector<double>& AdjustmentJob::disparity_offsets() const {
  return impl_->disparity_offsets();
}

void AdjustmentJob::apply(Map& map) const {
  impl_->write_back(map);
  impl_->remove_outliers(map);
}

std::array<Eigen::Vector3d, 4> tag_corners(double size) {
  const double h = size / 2;
  return {Eigen::Vector3d(-h, h, 0), {h, h, 0}, {h, -h, 0}, {-h, -h, 0}};
}

AdjustmentWindow local_window(const Map& map, int keyframe, int size) {
  AdjustmentWindow window;
  std::vector<char> role(map.keyframes().size(), 0);  // 1 moved, 2 fixed
  const auto at = [&](int id) -> char& { return role[static_cast<std::size_t>(id)]; };
  at(keyframe) = 1;
  for (const int id : map.covisible(keyframe, size - 1)) at(id) = 1;
  at(0) = 2;
  // Behind a odometry gap the map hangs on the keyframe that began it anew.
  for (const Keyframe& other : map.keyframes()) {
    if (other.link) at(other.id) = 2;
  }
  std::vector<char> visited(map.landmarks().size(), 0);
  for (std::size_t k = 0; k < role.size(); ++k) {
    if (role[k] != 1) continue;
    for (const std::vector<int>& view : map.keyframes()[k].landmarks) {
      for (const int id : view) {
        if (id < 0 || visited[static_cast<std::size_t>(id)]) continue;
        visited[static_cast<std::size_t>(id)] = 1;
        for (const Observation& o : map.landmark(id).observations) {
          if (at(o.keyframe) == 0) at(o.keyframe) = 2;
        }
      }
    }
  }
  for (std::size_t k = 0; k < role.size(); ++k) {
    if (role[k] == 1) window.moved.push_back(static_cast<int>(k));
    if (role[k] == 2) window.fixed.push_back(static_cast<int>(k));
  }
  return window;
}

AdjustmentWindow global_window(const Map& map) {
  bool held_by_tag = false;
  for (const MapTag& tag : map.tags()) held_by_tag |= tag.fixed;
  AdjustmentWindow window;
  for (const Keyframe& keyframe : map.keyframes()) {
    const bool fixed = keyframe.id == 0 && !held_by_tag;
    (fixed ? window.fixed : window.moved).push_back(keyframe.id);
  }
  return window;
}

void adjust(Map& map, const AdjustmentWindow& window, const EstimatorRig& rig,
            const AdjustmentOptions& options) {
  if (window.moved.empty()) return;
  AdjustmentJob job(map, window, rig, options);
  job.solve();
  job.apply(map);
}

}  // namespace vinebench::slam
