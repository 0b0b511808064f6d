// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "sim/world/world_generator.h"

namespace vinebench::harness {

/// A world to be generated and written.
struct WorldRequest {
  sim::WorldRecipe recipe;
  std::string out;     ///< file; the recipe's name and ".yaml" where empty
  bool force = false;  ///< overwrites a file that exists
};

/// Writes the world's file and returns a line that says what it holds. Throws Error.
std::string make_world(const WorldRequest& request);

}  // namespace vinebench::harness
