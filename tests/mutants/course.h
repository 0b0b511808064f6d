// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "core/util/worker_pool.h"
#include "harness/experiment/scenario.h"
#include "harness/judge/diagnosis.h"
#include "harness/judge/findings/discrepancy.h"
#include "harness/judge/findings/error_pattern.h"
#include "harness/judge/verdict.h"
#include "harness/machine.h"
#include "tests/mutants/kept_frames.h"
#include "tests/mutants/mutant.h"

namespace vinebench::mutants {

/// What a scenario's gates say of a mutant.
struct Outcome {
  Trajectory estimate;         ///< the poses of all frames, after all corrections
  std::optional<double> nees;  ///< mean, of the live poses with their covariances
  std::vector<harness::Check> failed;
  std::vector<harness::ErrorPattern> patterns;
  std::vector<harness::DegradedSegment> segments;
  std::vector<harness::Discrepancy> discrepancies;  ///< without those of the scenario itself
};

/// A scenario that mutants run through. The drive without a fault is drawn once.
class Course {
 public:
  /// Throws Error if the scenario cannot be read.
  Course(const std::filesystem::path& scenario, int threads);

  const std::string& name() const { return scenario_.name; }
  /// The SLAM core as it is.
  Outcome run_without_fault() { return run({}); }
  Outcome run(const Mutant& mutant);

 private:
  std::unique_ptr<SimulatedSource> simulate(const harness::ScenarioConfig& scenario);
  Outcome judge(FrameSource& source, const harness::ScenarioConfig& simulated,
                const Mutant& mutant);
  void drive(FrameSource& source, SlamSystem& honest, const Mutant& mutant,
             const harness::Trial& trial, Outcome& outcome) const;

  std::filesystem::path file_;
  harness::ScenarioConfig scenario_;
  harness::Machine machine_;
  WorkerPool pool_;
  std::unique_ptr<KeptFrames> frames_;
};

}  // namespace vinebench::mutants
