// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/hash_environment.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vinebench::harness {
namespace {

TEST(HashEnvironment, NamesWhatComputesTheLibrariesAndTheProcessor) {
  const NamedValues values = hash_environment({{"mujoco", "2.2.2"}});
  const auto has = [&](const std::string& name) {
    return std::count_if(values.begin(), values.end(),
                         [&](const auto& value) { return value.first == name; }) == 1;
  };
  for (const char* name :
       {"vinebench", "libm", "opencv", "shaders", "blas", "mujoco", "processor"}) {
    EXPECT_TRUE(has(name)) << name;
  }
}

TEST(HashEnvironment, DifferencesLeaveOutTheProcessor) {
  const NamedValues a{{"libm", "one"}, {"blas", "x"}, {"processor", "new"}};
  EXPECT_EQ(environment_differences(a, a), "");
  EXPECT_EQ(environment_differences(a, {{"libm", "one"}, {"blas", "x"}, {"processor", "old"}}), "");
  EXPECT_EQ(environment_differences(a, {{"libm", "two"}, {"processor", "new"}}), "blas, libm");
}

}  // namespace
}  // namespace vinebench::harness
