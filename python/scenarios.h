// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/jobs/commanded_drive.h"
#include "harness/jobs/frame_stream.h"
#include "python/arrays.h"

namespace vinebench::python {

/// The frames of a scenario and what was asked for.
struct Scenario {
  harness::FramesRequest request;
  std::shared_ptr<harness::FrameStream> stream;
};

/// A scenario that is driven by commands.
struct Drive {
  harness::FramesRequest request;
  std::shared_ptr<harness::CommandedDrive> drive;
};

/// As Python gives it.
harness::FramesRequest frames_request(const std::filesystem::path& scenario,
                                      std::optional<std::int64_t> seed,
                                      const std::map<std::string, py::object>& set,
                                      const std::optional<std::filesystem::path>& randomise,
                                      const std::vector<std::string>& cameras,
                                      const std::vector<std::string>& truth, int threads);

void define_scenario(py::module_& module);
void define_drive(py::module_& module);

}  // namespace vinebench::python
