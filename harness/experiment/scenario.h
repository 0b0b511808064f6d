// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/config/config_field.h"
#include "core/config/override.h"
#include "harness/datasets/format/recording_notes.h"
#include "harness/experiment/earlier_visit.h"
#include "harness/judge/expectations.h"
#include "harness/judge/trial.h"
#include "harness/systems/slam_choice.h"
#include "sim/simulation.h"
#include "slam/slam.h"

namespace vinebench::harness {

/// What runs of this very scenario over several seeds measured, and some more. It is not inherited
/// by scenarios that have this one as their base.
struct Guard {
  std::string seeds;    ///< of these runs
  std::string version;  ///< of the program that made them
  Expectations bounds;  ///< at the same level of the file
  template <class Archive>
  void serialize(Archive& archive) {
    archive("seeds", seeds);
    archive("version", version);
    bounds.serialize(archive);
  }
};

/// One experiment: a world, a rover, its route, a SLAM system and what is expected of the run.
struct ScenarioConfig {
  std::string name;                  ///< of the scenario and its results
  std::string description;           ///< a line, for lists
  std::int64_t seed = 1;             ///< of the vineyard, of noise and of all else that is drawn
  sim::SimulationConfig simulation;  ///< its fields are at the top level of the file
  std::vector<sim::Occluder> occluders;     ///< added to those of the world
  std::vector<sim::WorldConfig::Tag> tags;  ///< likewise
  std::optional<EarlierVisit> earlier_visit;
  SlamChoice slam;
  Expectations expectations;
  Expectations goal;           ///< what the scenario exists to show
  Expectations now;            ///< bounds in place of those of the goal that are not reached yet
  std::optional<Guard> guard;  ///< written by `vinebench guard`
  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("description", description);
    archive("seed", seed, Range::non_negative());
    simulation.serialize(archive);
    sim::serialize_occluders(archive, occluders, false);
    archive("tags", tags);
    archive("earlier_visit", earlier_visit);
    archive("slam", slam);
    archive("expectations", expectations);
    archive("goal", goal);
    archive("now", now);
    archive("guard", guard);
    archive.require(!name.empty(), "name", "expected a name");
    archive.require(name.find('/') == std::string::npos, "name", "expected a name without '/'");
    archive.require(!name.starts_with('.'), "name", "expected a name that begins with no '.'");
  }
};

/// Reads a scenario. `base` names another one from which missing keys are inherited. `world` and
/// `rover` may be maps or names of files beside the scenario; overrides are applied after those are
/// included, so that "world.sun.elevation_deg" works. Occluders and tags of the scenario are
/// moved into its world. The rig is read too, so that its errors are reported first. Throws Error
/// that names file, line and key.
ScenarioConfig load_scenario(const std::filesystem::path& file,
                             const std::vector<Override>& overrides = {});

/// The YAML text of a scenario with all defaults resolved and its world written out. Reading it
/// gives the same experiment.
std::string resolved_settings(ScenarioConfig scenario);

/// The context of a scenario's run for the evaluation. The guard, measured with the SLAM core, is
/// left out for other systems.
Trial trial_of(const ScenarioConfig& scenario);

/// What the SLAM system is told of the tags.
std::vector<RegisteredTag> registered_tags(const ScenarioConfig& scenario);

/// The notes of a scenario's run. Throws Error if the rig's file cannot be read.
RecordingNotes notes_of(const ScenarioConfig& scenario);

}  // namespace vinebench::harness
