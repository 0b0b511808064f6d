// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/versions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core/version.hpp>

#include "vinebench/version.h"

namespace vinebench::tools {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(Versions, NamesTheProgramAndTheLibrariesOneALine) {
  const std::string text = versions_text(harness::machine_of_environment());
  EXPECT_THAT(text, StartsWith(std::string("vinebench ") + kVersion + "\n"));
  EXPECT_THAT(text, HasSubstr("\n  OpenCV     " CV_VERSION "\n"));
  for (const char* name : {"Eigen", "Ceres", "AprilTag", "CLI11", "fmt", "xxHash"}) {
    EXPECT_THAT(text, HasSubstr(std::string("\n  ") + name + " "));
  }
}

}  // namespace
}  // namespace vinebench::tools
