// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/explain/variant_drive.h"
#include "slam/slam.h"

namespace vinebench::harness {

/// One frame of a rerun.
struct Step {
  std::int64_t index = 0;
  Stamp stamp = 0;
  Pose T_world_body;                 ///< the truth
  std::optional<Pose> T_map_body{};  ///< live
  bool tracked = false;              ///< as is_tracked()
};

Step step_of(const Sample& sample, const Estimate& estimate);

/// A part of a drive that was estimated again.
struct Rerun {
  bool same_drive = true;  ///< VariantDrive::is_same_drive(); else there are no steps
  double seconds = 0;      ///< processor time
  std::vector<Step> steps{};
};

/// What this process has already, for reruns in forks of it.
struct Prepared {
  std::shared_ptr<sim::DrawnScene> drawn{};  ///< the scene as it was; may be missing
  slam::MappingSystem* slam = nullptr;       ///< has processed the frames before the splice
};

/// Estimates a variant's frames up to the one of index `last`: with the prepared estimator, or with
/// one of its own from the first frame on.
Rerun run_variant(const Variant& variant, const Splice& splice, std::int64_t last,
                  const Machine& machine, const Prepared& prepared);

/// A rerun as text between processes, and back.
std::string pack_rerun(const Rerun& rerun);
Rerun unpack_rerun(const std::string& content);

}  // namespace vinebench::harness
