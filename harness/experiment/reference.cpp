// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/reference.h"

#include "core/geometry/rig.h"
#include "harness/experiment/randomisation.h"
#include "harness/experiment/scenario.h"
#include "sim/plants/cultivar.h"

namespace vinebench::harness {
namespace {

/// What load_scenario() reads before the rest.
ConfigField base_field() {
  return {"base", "", "base", "file", "", ""};
}

std::vector<ConfigField> scenario_fields() {
  std::vector<ConfigField> fields = list_fields<ScenarioConfig>();
  fields.insert(fields.begin(), base_field());
  return fields;
}

}  // namespace

std::vector<FileKeys> file_keys() {
  return {{"scenario",
           "An experiment. `world` and `rover` are names of files with these keys, or the keys "
           "themselves.",
           scenario_fields()},
          {"rig", "The cameras of a rover, which names the file in `rover.rig`.",
           list_fields<RigConfig>()},
          {"cultivar", "A kind of vine, named in `world.vines.cultivar`.",
           list_fields<sim::Cultivar>()},
          {"randomisation", "What `--randomise` draws keys of a scenario from.",
           randomisation_fields()}};
}

}  // namespace vinebench::harness
