// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/versions.h"

#include <ceres/version.h>
#include <fmt/format.h>
#include <xxhash.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <opencv2/core/utility.hpp>

#include "core/util/arithmetic.h"
#include "tools/commands/simulation.h"
#include "vinebench/version.h"

namespace vinebench::tools {

std::string versions_text(const harness::Machine& machine) {
  std::string text = fmt::format("vinebench {}\n", kVersion);
  const auto add = [&](const char* name, const std::string& version) {
    text += fmt::format("  {:<10} {}\n", name, version);
  };
  for (const auto& [name, version] : simulation_versions(machine)) add(name.c_str(), version);
  add("OpenCV", cv::getVersionString());
  add("Eigen",
      fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
  add("Ceres", CERES_VERSION_STRING);
  add("AprilTag", VINEBENCH_APRILTAG_VERSION);
  add("CLI11", CLI11_VERSION);
  add("fmt",
      fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100));
  add("xxHash", fmt::format("{}.{}.{}", XXH_versionNumber() / 10000,
                            XXH_versionNumber() / 100 % 100, XXH_versionNumber() % 100));
  for (const auto& [name, value] : arithmetic_of_process()) {
    if (name != "opencv" || cv::useOptimized()) add(name.c_str(), value);
  }
  add("processor", processor_text());
  return text;
}

}  // namespace vinebench::tools
