// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/files/json_file.h"
#include "harness/report/run_folder.h"
#include "harness/run.h"
#include "tests/support/fakes.h"

namespace vinebench::test {

/// A run of the fakes in a folder, with a film if `film`.
inline harness::RunReport write_fake_run(const std::filesystem::path& folder, bool film = false,
                                         const harness::Trial& trial = fake_trial(),
                                         FakeSlam::Change change = {}) {
  prepare_fake_folder(folder);
  FakeSource source;
  FakeSlam slam(std::move(change));
  harness::RunOptions options;
  options.folder = folder;
  options.film = film;
  return run_lockstep_and_judge(trial, source, slam, options).report;
}

}  // namespace vinebench::test
