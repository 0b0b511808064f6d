// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/run_inputs.h"

#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

TEST(RunInputsTest, TheSeedAndEverySettingCount) {
  ScenarioConfig scenario;
  const std::string first = fingerprint_of_inputs(scenario);
  EXPECT_EQ(first.size(), 32u);  // 128 bits
  EXPECT_EQ(fingerprint_of_inputs(scenario), first);
  scenario.seed += 1;
  EXPECT_NE(fingerprint_of_inputs(scenario), first);
  scenario.seed -= 1;
  scenario.slam.tracking.radius += 1;
  EXPECT_NE(fingerprint_of_inputs(scenario), first);
}

TEST(RunInputsTest, TheContentOfANamedFileCounts) {
  const test::TestFolder folder;
  ScenarioConfig scenario;
  scenario.simulation.world.vines.cultivar = folder.write("red.yaml", "name: red\n");
  const std::string first = fingerprint_of_inputs(scenario);
  folder.write("red.yaml", "name: dark\n");
  EXPECT_NE(fingerprint_of_inputs(scenario), first);
  folder.write("red.yaml", "name: red\n");
  EXPECT_EQ(fingerprint_of_inputs(scenario), first);
}

}  // namespace
}  // namespace vinebench::harness
