// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/pin_arithmetic.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/core/utility.hpp>
#include <string>

namespace vinebench {
namespace {

TEST(PinArithmetic, TurnsOpenCvsDispatchOffAndKeepsShadersApartOnce) {
  const bool optimised = cv::useOptimized();
  setenv("MESA_SHADER_CACHE_DIR", "/shaders", 1);
  pin_arithmetic();
  EXPECT_FALSE(cv::useOptimized());
  const std::string folder = std::getenv("MESA_SHADER_CACHE_DIR");
  EXPECT_TRUE(folder.starts_with("/shaders/vinebench-shaders-"));
  pin_arithmetic();  // as in a child process
  EXPECT_EQ(folder, std::getenv("MESA_SHADER_CACHE_DIR"));
  unsetenv("MESA_SHADER_CACHE_DIR");
  cv::setUseOptimized(optimised);
}

}  // namespace
}  // namespace vinebench
