// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/arithmetic.h"

#include <gtest/gtest.h>

#include <map>
#include <opencv2/core/utility.hpp>

namespace vinebench {
namespace {

TEST(Arithmetic, NamesTheProcessorsFeaturesWhereTheyChooseTheCode) {
  const bool optimised = cv::useOptimized();
  cv::setUseOptimized(true);
  const NamedValues chosen = arithmetic_of_process();
  cv::setUseOptimized(false);
  const NamedValues baseline = arithmetic_of_process();
  cv::setUseOptimized(optimised);
  std::map<std::string, std::string> values(chosen.begin(), chosen.end());
  std::map<std::string, std::string> pinned(baseline.begin(), baseline.end());
  // A test program has the C library's functions.
  EXPECT_TRUE(values.at("libm").starts_with("glibc 2."));
  EXPECT_NE(values.at("libm").find(" for "), std::string::npos);
  EXPECT_NE(values.at("opencv").find(" for "), std::string::npos);
  EXPECT_EQ(pinned.at("opencv"), cv::getVersionString() + " baseline");
  EXPECT_EQ(values.at("libm"), pinned.at("libm"));
}

TEST(Arithmetic, TextHasEveryValue) {
  const std::string text = arithmetic_text();
  for (const auto& [name, value] : arithmetic_of_process()) {
    EXPECT_NE(text.find(name + ": " + value), std::string::npos) << name;
  }
  EXPECT_FALSE(processor_text().empty());
}

}  // namespace
}  // namespace vinebench
