// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/bundle_adjustment.h"

#include <atomic>
#include <optional>
#include <vector>

#include "slam/optimisation/calibration_unknowns.h"
#include "slam/optimisation/gravity_factors.h"
#include "slam/optimisation/landmark_factors.h"
#include "slam/optimisation/odometry_factors.h"
#include "slam/optimisation/problem_builder.h"
#include "slam/optimisation/tag_factors.h"

namespace vinebench::slam {

namespace {

/// Relative decrease of the cost at which a global adjustment is done.
constexpr double kGlobalTolerance = 1e-5;

/// Beyond so many keyframes their normal equations are solved by conjugate gradients: what is far
/// away is seen from everywhere, so that they have few zeros, and to factor them takes the cube of
/// their number.
constexpr std::size_t kManyKeyframes = 400;

ceres::Solver::Options solver_options(const AdjustmentOptions& adjustment) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.dense_linear_algebra_library_type = ceres::EIGEN;
  options.max_num_iterations = adjustment.iterations;
  options.function_tolerance = adjustment.global ? kGlobalTolerance : 1e-6;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace

/// The sources stand in the order in which they add their factors.
class AdjustmentJob::Impl {
 public:
  Impl(const Map& map, const AdjustmentWindow& window, const EstimatorRig& rig,
       const AdjustmentOptions& options)
      : rig_(rig),
        options_(options),
        calibration_(unknown_calibration(rig_, options)),
        landmarks_(rig_, options.min_keyframes, calibration_.get()),
        gravity_(options.inertial, options.global),
        tags_(rig_.tag_cameras, options.tag_corner_sigma, options.global),
        moved_(window.moved) {
    problem_.emplace(map, window, options.global && moved_.size() > kManyKeyframes);
    if (calibration_) calibration_->add_to(*problem_, map);
    if (calibration_ && options.tag_measures) {
      tag_measures_.emplace(rig_, *options.tag_measures, *calibration_);
    }
    for (FactorSource* source : sources()) source->add_to(*problem_, map);
  }

  double solve() {
    if (problem_->of_many()) {
      return problem_->solve(SchurOptions{.iterations = options_.iterations}, stop_.wanted);
    }
    ceres::Solver::Options options = solver_options(options_);
    options.callbacks.push_back(&stop_);
    return problem_->solve(options);
  }

  void stop() { stop_.wanted = true; }

  void conclude(const Map& map) {
    poses_ = problem_->poses(map);
    problem_.reset();
    for (FactorSource* source : sources()) source->conclude(poses_, map);
  }

  void apply(Map& map) {
    if (problem_) conclude(map);
    for (const int id : moved_) map.keyframe(id).T_map_body = poses_[static_cast<std::size_t>(id)];
    for (const FactorSource* source : sources()) source->write_back(map);
  }

  CalibrationMarginal calibration() { return calibration_->marginal(*problem_); }

 private:
  /// Ends a solver's iterations once that is wanted.
  struct Stop : ceres::IterationCallback {
    ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
      return wanted ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }
    std::atomic<bool> wanted = false;
  };

  static std::unique_ptr<CalibrationUnknowns> unknown_calibration(
      const EstimatorRig& rig, const AdjustmentOptions& options) {
    if (!options.calibration) return nullptr;
    return std::make_unique<CalibrationUnknowns>(rig, *options.calibration);
  }
  std::vector<FactorSource*> sources() {
    std::vector<FactorSource*> sources{&landmarks_, &odometry_, &gravity_};
    if (tag_measures_) {
      sources.push_back(&*tag_measures_);
    } else if (options_.tags) {
      sources.push_back(&tags_);
    }
    return sources;
  }

  const EstimatorRig rig_;  // a copy: calibration may change the estimator's own meanwhile
  AdjustmentOptions options_;
  Stop stop_;
  std::unique_ptr<CalibrationUnknowns> calibration_;
  LandmarkFactors landmarks_;
  OdometryFactors odometry_;
  GravityFactors gravity_;
  TagFactors tags_;
  std::optional<TagMeasures> tag_measures_;
  std::vector<int> moved_;
  std::vector<Pose> poses_;                ///< found, by keyframe
  std::optional<ProblemBuilder> problem_;  // last: it must go before what it points to
};

AdjustmentJob::AdjustmentJob(const Map& map, const AdjustmentWindow& window,
                             const EstimatorRig& rig, const AdjustmentOptions& options)
    : impl_(std::make_unique<Impl>(map, window, rig, options)) {}

AdjustmentJob::~AdjustmentJob() = default;

double AdjustmentJob::solve() {
  return impl_->solve();
}

void AdjustmentJob::stop() {
  impl_->stop();
}

CalibrationMarginal AdjustmentJob::calibration() const {
  return impl_->calibration();
}

void AdjustmentJob::conclude(const Map& map) {
  impl_->conclude(map);
}

void AdjustmentJob::apply(Map& map) const {
  impl_->apply(map);
}

void adjust(Map& map, const AdjustmentWindow& window, const EstimatorRig& rig,
            const AdjustmentOptions& options) {
  if (window.moved.empty()) return;
  AdjustmentJob job(map, window, rig, options);
  job.solve();
  job.apply(map);
}

}  // namespace vinebench::slam
