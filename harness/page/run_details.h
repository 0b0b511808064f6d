// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace vinebench::harness {

/// What a page draws of one run, from the files of its folder: true and estimated path (in the
/// world, with the first poses aligned; m), errors (mm), status, counts and covariances by frame,
/// events, landmarks, what stands in the vineyard, the scenario and the run's metrics. Of more than
/// `most_frames` frames, every n-th. What an older run or a recording lacks is absent. Throws Error
/// with the file for one that is damaged.
nlohmann::ordered_json run_details(const std::filesystem::path& folder, std::size_t most_frames);

/// Whether a folder is one of a run, complete or interrupted.
bool is_run_folder(const std::filesystem::path& folder);

}  // namespace vinebench::harness
