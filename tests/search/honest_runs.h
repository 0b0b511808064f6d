// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "core/util/worker_pool.h"
#include "harness/machine.h"
#include "harness/run/run_record.h"
#include "harness/sets/run_set.h"
#include "tests/search/planted_faults.h"

namespace vinebench::search_faults {

/// Runs of the SLAM core as it is, each made once for any number of faults.
class HonestRuns {
 public:
  explicit HonestRuns(int threads);

  /// As the makers of a search's runs: those of the system have the fault, those of the reference
  /// have none.
  harness::SetOutcome make(const std::vector<harness::PlannedRun>& plan, const PlantedFault& fault);

  const harness::RunRecord& record_of(const harness::ScenarioConfig& scenario);
  std::size_t size() const { return records_.size(); }

 private:
  harness::Machine machine_;
  WorkerPool pool_;
  std::map<std::string, harness::RunRecord> records_;  ///< by the fingerprint of their inputs
};

}  // namespace vinebench::search_faults
