// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/config/field_list.h"
#include "harness/experiment/scenario.h"

namespace vinebench::harness {

/// Draws the keys of a scenario that a file of distributions names, for one seed:
///
///     draws:
///       - {key: world.sun.elevation_deg, uniform: [15, 70]}
///       - {key: world.vines.leaf_density, normal: [1, 0.2], min: 0.4, max: 1.6}
///       - {key: sensors.camera.exposure.time, log_uniform: [0.0005, 0.008]}
///       - {key: world.vines.bbch, choice: [75, 83, 89], weights: [1, 2, 1]}
///       - {key: world.vines.templates, integer: [4, 8]}
///       - {key: world.vines.cultivar, file: [../../cultivars/merlot.yaml,
///       ../../cultivars/riesling.yaml]}
///
/// A draw is a function of the seed and the key only. Throws Error that names file, line and key;
/// the values themselves are validated when the scenario is read.
std::vector<Override> draw_overrides(const std::filesystem::path& file, std::int64_t seed);

/// The text of a randomisation with the same keys, narrowed to what some seeds draw from `file`:
/// least and most of numbers, mean and deviation of normal ones, the choices with their counts as
/// weights. Throws Error as draw_overrides().
std::string narrowed_randomisation(const std::filesystem::path& file,
                                   const std::vector<std::int64_t>& seeds);

/// load_scenario() with the draws of its seed (the scenario's own if none is given); no
/// randomisation if that file's name is empty.
ScenarioConfig load_drawn_scenario(const std::filesystem::path& file,
                                   std::vector<Override> overrides,
                                   const std::filesystem::path& randomisation,
                                   std::optional<std::int64_t> seed);

/// The keys of a file of distributions.
std::vector<ConfigField> randomisation_fields();

}  // namespace vinebench::harness
