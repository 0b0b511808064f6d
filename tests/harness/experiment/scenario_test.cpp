// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/yaml_writer.h"
#include "core/files/files.h"
#include "core/util/error.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

class ScenarioTest : public testing::Test {
 protected:
  void SetUp() override {
    write_file_atomically(folder_ / "world.yaml", R"(name: small
rows:
  - {start: [0, 0], end: [4, 0]}
tags:
  - {id: 3, position: [0, 0.1, 0.5]}
boxes:
  - {position: [9, 9]}
)");
    write_file_atomically(folder_ / "rover.yaml", "model: rover.xml\nrig: rig.yaml\n");
    write_file_atomically(folder_ / "rover.xml", "<mujoco/>");
    fs::copy_file(fs::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover/rig.yaml",
                  folder_ / "rig.yaml");
  }

  fs::path write(const std::string& more) {
    const fs::path file = folder_ / "scenario.yaml";
    write_file_atomically(file, "name: test\nworld: world.yaml\nrover: rover.yaml\n" + more);
    return file;
  }
  std::string error_of(const std::string& more, const std::vector<Override>& overrides = {}) {
    try {
      load_scenario(write(kRoute + more), overrides);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  const std::string kRoute = "route: {waypoints: [{position: [0, 1]}]}\n";
  test::TestFolder folder_;
};

TEST_F(ScenarioTest, ReadsItsPartsFromTheirFiles) {
  const ScenarioConfig scenario = load_scenario(write(kRoute + R"(seed: 5
boxes: [{position: [1, 2]}]
tags: [{id: 4}]
expectations: {losses_max: 0, blind: {cameras: front_left}}
)"));
  EXPECT_EQ(scenario.seed, 5);
  EXPECT_EQ(scenario.simulation.world.name, "small");
  EXPECT_EQ(scenario.simulation.rover.model, fs::absolute(folder_ / "rover.xml"));
  ASSERT_EQ(scenario.simulation.world.occluders.size(), 2u);
  EXPECT_EQ(scenario.simulation.world.occluders[1].position, Eigen::Vector2d(1, 2));
  ASSERT_EQ(scenario.simulation.world.tags.size(), 2u);
  EXPECT_EQ(scenario.simulation.world.tags[1].id, 4);
  EXPECT_TRUE(scenario.occluders.empty());
  EXPECT_EQ(scenario.expectations.losses_max, 0);
  EXPECT_FALSE(scenario.expectations.coverage_min);
  EXPECT_EQ(scenario.expectations.blind->seconds, 3);
}

TEST_F(ScenarioTest, OverridesReachIntoItsParts) {
  const ScenarioConfig scenario =
      load_scenario(write(kRoute), {{"world.sun.elevation_deg", "20"}, {"slam.cameras", "front"}});
  EXPECT_EQ(scenario.simulation.world.sun.elevation_deg, 20);
  EXPECT_EQ(scenario.slam.cameras, std::vector<std::string>{"front"});
}

TEST_F(ScenarioTest, AnOverrideMayNameAnotherWorld) {
  write_file_atomically(folder_ / "other.yaml", "name: other\nrows: [{end: [1, 0]}]\n");
  const std::vector<Override> overrides{{"world.sun.elevation_deg", "20"},
                                        {"world", (folder_ / "other.yaml").string()}};
  const ScenarioConfig scenario = load_scenario(write(kRoute), overrides);
  EXPECT_EQ(scenario.simulation.world.name, "other");
  EXPECT_EQ(scenario.simulation.world.sun.elevation_deg, 20);
}

TEST_F(ScenarioTest, ABaseHoldsWhereTheScenarioIsSilent) {
  write(kRoute +
        "seed: 5\nboxes: [{position: [1, 2]}]\nsensors: {wheels: {counts_per_turn: 99}}\n");
  const fs::path file = folder_ / "below" / "derived.yaml";
  fs::create_directories(file.parent_path());
  write_file_atomically(file, R"(base: ../scenario.yaml
name: derived
world: {sun: {elevation_deg: 20}}
boxes: []
slam: {cameras: front}
)");
  const ScenarioConfig scenario = load_scenario(file, {{"seed", "7"}});
  EXPECT_EQ(scenario.name, "derived");
  EXPECT_EQ(scenario.seed, 7);
  EXPECT_EQ(scenario.simulation.sensors.wheels.counts_per_turn, 99);
  EXPECT_EQ(scenario.simulation.world.name, "small");  // merged with the base's world
  EXPECT_EQ(scenario.simulation.world.sun.elevation_deg, 20);
  EXPECT_EQ(scenario.simulation.world.occluders.size(), 1u);  // the world's own; lists are replaced
  EXPECT_EQ(scenario.simulation.route.waypoints.size(), 1u);
  EXPECT_EQ(scenario.simulation.rover.model, fs::absolute(folder_ / "rover.xml"));
}

TEST_F(ScenarioTest, ABaseMayHaveABaseAndAnotherWorldReplacesIt) {
  write(kRoute + "seed: 5\n");
  write_file_atomically(folder_ / "middle.yaml", "base: scenario.yaml\nname: middle\n");
  fs::create_directories(folder_ / "below");
  write_file_atomically(folder_ / "below" / "world.yaml", "name: other\nrows: [{end: [1, 0]}]\n");
  const fs::path file = folder_ / "below" / "derived.yaml";
  write_file_atomically(file, "base: ../middle.yaml\nworld: world.yaml\n");
  const ScenarioConfig scenario = load_scenario(file);
  EXPECT_EQ(scenario.name, "middle");
  EXPECT_EQ(scenario.seed, 5);
  EXPECT_EQ(scenario.simulation.world.name, "other");
  EXPECT_TRUE(scenario.simulation.world.occluders.empty());
}

TEST_F(ScenarioTest, ErrorsNameTheFileOfTheBaseOrOfTheScenario) {
  const fs::path file = folder_ / "derived.yaml";
  const auto error_with = [&](const std::string& base, const std::string& derived) {
    write(kRoute + base);
    write_file_atomically(file, derived);
    try {
      load_scenario(file);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error_with("sede: 1\n", "base: scenario.yaml\n"),
              testing::HasSubstr("scenario.yaml:5: sede: unknown key"));
  EXPECT_THAT(error_with("", "base: scenario.yaml\nseed: 3\nslam: {camera: front}\n"),
              testing::HasSubstr("derived.yaml:3: slam.camera: unknown key"));
  EXPECT_THAT(error_with("seed: 2\n", "base: scenario.yaml\nseed: -1\n"),
              testing::HasSubstr("derived.yaml:2: seed: expected"));
  EXPECT_THAT(error_with("", "base: nowhere.yaml\n"),
              testing::HasSubstr("derived.yaml:1: base: expected a file, found none at"));
  EXPECT_THAT(error_with("", "base: derived.yaml\n"),
              testing::HasSubstr("is derived from this file"));
}

TEST_F(ScenarioTest, ResolvedTextIsTheSameScenario) {
  const std::string text =
      resolved_settings(load_scenario(write(kRoute + R"(
description: >
  Two lines with "quotes" and a \ in them
  that are one.
boxes: [{position: [0.1, 2]}]
expectations: {ate_rmse_max: 0.1, blind: {cameras: [side]}}
)"),
                                      {{"world.sun.elevation_deg", "20.125"}}));
  const fs::path resolved = folder_ / "elsewhere" / "scenario.resolved.yaml";
  fs::create_directories(resolved.parent_path());
  write_file_atomically(resolved, text);
  EXPECT_EQ(resolved_settings(load_scenario(resolved)), text);
}

TEST_F(ScenarioTest, ErrorsNameFileLineAndKey) {
  EXPECT_THAT(error_of("sede: 1\n"), testing::HasSubstr("scenario.yaml:5: sede: unknown key"));
  EXPECT_THAT(error_of("seed: -1\n"), testing::HasSubstr("scenario.yaml:5: seed: expected"));
  EXPECT_THAT(error_of("", {{"name", ".."}}),
              testing::HasSubstr("--set name=..: name: expected a name that begins with no '.'"));
  EXPECT_THAT(error_of("expectations: {coverage_min: 2}\n"),
              testing::HasSubstr("scenario.yaml:5: expectations.coverage_min: expected"));
  EXPECT_THAT(
      error_of("tags: [{id: 99999}]\n"),
      testing::AllOf(testing::HasSubstr("scenario.yaml:5:"), testing::HasSubstr("tags.0.id")));
  EXPECT_THAT(error_of("expectations: {blind: {cameras: top}}\n"),
              testing::HasSubstr("expectations.blind.cameras: the rig has no camera 'top'"));
  EXPECT_THAT(error_of("", {{"world.sun.elevation", "3"}}),
              testing::HasSubstr("--set world.sun.elevation=3: world.sun.elevation: unknown key"));
  EXPECT_THAT(error_of("", {{"world.vines.meshes", "[nowhere.glb]"}}),
              testing::HasSubstr("world.vines.meshes.0: expected a file, found none at"));
  EXPECT_THAT(error_of("", {{"world", "nowhere.yaml"}}), testing::HasSubstr("nowhere.yaml"));
  write_file_atomically(folder_ / "world.yaml", "name: small\nrows: 5\n");
  EXPECT_THAT(error_of(""), testing::HasSubstr("world.yaml:2: world.rows: expected a list"));
}

TEST_F(ScenarioTest, ParsesOverrides) {
  EXPECT_EQ(parse_override("a.b=c=d"), Override("a.b", "c=d"));
  EXPECT_EQ(parse_override("a="), Override("a", ""));
  EXPECT_THROW(parse_override("a.b"), Error);
  EXPECT_THROW(parse_override("=1"), Error);
}

TEST(ShippedScenariosTest, AreValid) {
  const fs::path folder = fs::path(VINEBENCH_SOURCE_DIR) / "scenarios";
  int count = 0;
  for (const fs::path& part : {folder, folder / "ablations", folder / "short"}) {
    for (const auto& entry : fs::directory_iterator(part)) {
      if (entry.path().extension() != ".yaml") continue;
      const ScenarioConfig scenario = load_scenario(entry.path());
      EXPECT_EQ(scenario.name, entry.path().stem());
      EXPECT_NO_THROW(load_rig(scenario.simulation.rover.rig));
      ++count;
    }
  }
  EXPECT_GE(count, 2);
}

// A guard is a measurement of one scenario; what is derived from it has another difficulty.
TEST_F(ScenarioTest, AGoalIsInheritedAndAGuardIsNot) {
  write(kRoute + R"(
goal: {losses_max: 0, ate_rmse_max: 0.02}
guard: {seeds: 1..10, version: "1", ate_rmse_max: 0.01}
)");
  const Trial base = trial_of(load_scenario(folder_ / "scenario.yaml"));
  EXPECT_EQ(base.guard.ate_rmse_max, 0.01);
  EXPECT_EQ(base.goal.ate_rmse_max, 0.02);
  write_file_atomically(folder_ / "derived.yaml",
                        "base: scenario.yaml\nname: derived\ngoal: {losses_max: null}\n");
  const ScenarioConfig derived = load_scenario(folder_ / "derived.yaml");
  EXPECT_FALSE(derived.guard);
  EXPECT_FALSE(derived.goal.losses_max);
  EXPECT_EQ(derived.goal.ate_rmse_max, 0.02);
  // What is set on the command line is judged by the guard all the same.
  EXPECT_TRUE(load_scenario(folder_ / "scenario.yaml", {{"sensors.wheels.counts_per_turn", "99"}})
                  .guard.has_value());
}

TEST_F(ScenarioTest, TheGuardIsOfTheSlamCoreAlone) {
  ScenarioConfig scenario =
      load_scenario(write(kRoute + "guard: {seeds: 1..10, version: \"1\", losses_max: 0}\n"));
  EXPECT_EQ(trial_of(scenario).guard.losses_max, 0);
  scenario.slam.plugin.emplace();
  EXPECT_FALSE(trial_of(scenario).guard.losses_max);
}

TEST_F(ScenarioTest, OneOcclusionIsMeasured) {
  EXPECT_THAT(error_of("goal: {blind: {cameras: side}}\nexpectations: {blind: {cameras: side}}\n"),
              testing::HasSubstr("blind: expected in expectations or in goal, found in both"));
  EXPECT_THAT(error_of("guard: {blind: {cameras: side}}\n"),
              testing::HasSubstr("guard.blind: expected in expectations or in goal"));
  EXPECT_THAT(error_of("goal: {blind: {cameras: top}}\n"), testing::HasSubstr("no camera 'top'"));
}

TEST_F(ScenarioTest, BoundsForNowAreOfGoals) {
  EXPECT_EQ(error_of("goal: {losses_max: 0}\nnow: {losses_max: 2}\n"), "no error");
  EXPECT_THAT(error_of("goal: {losses_max: 0}\nnow: {coverage_min: 0.5}\n"),
              testing::HasSubstr("now.coverage_min: expected only beside goal.coverage_min"));
  EXPECT_THAT(error_of("now: {blind: {cameras: [front_left]}}\n"),
              testing::HasSubstr("now.blind: expected in expectations or in goal"));
}

TEST_F(ScenarioTest, AnEarlierVisitNeedsTheBuiltInCore) {
  EXPECT_EQ(error_of("earlier_visit: {bbch: 75}\n"), "no error");
  EXPECT_THAT(error_of("earlier_visit: {bbch: 75}\nslam: {plugin: {library: rig.yaml}}\n"),
              testing::HasSubstr("earlier_visit: requires the built-in SLAM core"));
  EXPECT_THAT(error_of("earlier_visit: {season: winter}\n"), testing::HasSubstr("season"));
}

}  // namespace
}  // namespace vinebench::harness
