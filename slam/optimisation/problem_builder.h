// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/ceres.h>

#include <atomic>
#include <vector>

#include "slam/factors/pose_manifold.h"
#include "slam/optimisation/adjustment_window.h"
#include "slam/solver/schur_solver.h"

namespace vinebench::slam {

/// A least-squares problem over the keyframes of a window, put together from the factors of whoever
/// has some. Blocks and factors are added in a fixed order, so that the problem is the same every
/// time. It owns the keyframes' poses; other blocks and all factors belong to those who add them,
/// and must stay where they are until the builder is gone.
class ProblemBuilder {
 public:
  /// The order in which unknowns are eliminated (Schur complement); the first are landmarks. Ceres
  /// orders those of a group by their addresses, so the blocks of a group must be parts of one
  /// array: those of two would be ordered by what was allocated before, and the last bits with
  /// them.
  enum class Group {
    kLandmarks = 0,
    kInertial = 1,
    kTagMeasures = 2,
    kVelocities = 3,
    kPoses = 4,
    kTags = 5,
    kCameras = 6,
    kLenses = 7,
    kTagTimes = 8
  };

  /// `many`: by solve_by_schur(), for very many keyframes. No calibration can be unknown then.
  ProblemBuilder(const Map& map, const AdjustmentWindow& window, bool many = false);
  ProblemBuilder(const ProblemBuilder&) = delete;
  ProblemBuilder& operator=(const ProblemBuilder&) = delete;

  const AdjustmentWindow& window() const { return window_; }
  bool takes_part(int keyframe) const;
  /// The block of a keyframe that takes part.
  double* pose_of(int keyframe);

  /// Adds unknowns: `size` numbers, or a pose as PoseManifold has it.
  void add_block(double* block, int size, Group group);
  void add_pose(double* block, Group group);
  void hold(double* block) { problem_.SetParameterBlockConstant(block); }

  /// Of many keyframes landmarks have no blocks and factors of their own here.
  bool of_many() const { return many_; }
  /// Instead, these points are seen from these keyframes: ascending by point, in the order of
  /// `factors`.
  void set_sights(const Sights& factors, std::vector<double*> points, std::vector<Sight> sights);
  /// Place of a keyframe that takes part among those poses.
  std::size_t place_of(int keyframe) const {
    return pose_index_[static_cast<std::size_t>(keyframe)];
  }

  /// `loss` may be null: squared.
  void add_factor(ceres::CostFunction& factor, ceres::LossFunction* loss,
                  const std::vector<double*>& blocks);

  /// Half the sum of the squared residuals in the end, under their losses.
  double solve(ceres::Solver::Options options);

  /// The same of many keyframes.
  double solve(const SchurOptions& options, const std::atomic<bool>& stop);

  /// What a part of the unknowns has to do with the others.
  struct Marginal {
    Eigen::MatrixXd information;  ///< of the part, once the others are eliminated
    /// Step of the last moved keyframe's pose for each of the part's numbers that is 1 larger, all
    /// others being as the factors then have them best: six rows.
    Eigen::MatrixXd of_last_pose;
  };

  /// What the factors, linearised where the blocks are, say of the last groups' unknowns with all
  /// others unknown too (Schur complement), in the order of groups and blocks. There must be none
  /// between the poses and these.
  Marginal marginal(const std::vector<Group>& last_groups);

  /// Poses of all of the map's keyframes by id, of the moved ones as they were found.
  std::vector<Pose> poses(const Map& map) const;

 private:
  AdjustmentWindow window_;
  bool many_;
  Unknowns of_many_;
  PoseManifold manifold_;
  std::vector<PoseBlock> poses_;
  std::vector<std::size_t> pose_index_;  ///< by keyframe id
  ceres::ParameterBlockOrdering ordering_;
  ceres::Problem problem_;  // last: it must go before the blocks it points to
};

/// Whoever has factors for an adjustment: landmarks, tags, wheels.
class FactorSource {
 public:
  virtual ~FactorSource() = default;
  virtual void add_to(ProblemBuilder& problem, const Map& map) = 0;
  /// Once the blocks have their values and the problem is gone: finds what else is to be written
  /// back. The keyframes, of the poses given by id, and landmarks are those that add_to() saw.
  virtual void conclude(const std::vector<Pose>&, const Map&) {}
  /// Writes the values of its own blocks into the map, and what it concluded.
  virtual void write_back(Map&) const {}
};

}  // namespace vinebench::slam
