// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/config/override.h"
#include "harness/catalogue/catalogue.h"
#include "harness/machine.h"
#include "harness/realism/realism_fit.h"
#include "harness/realism/realism_page.h"
#include "harness/realism/world_views.h"

namespace vinebench::harness {

/// What `vinebench realism` is asked for.
struct RealismRequest {
  std::string photographs;        ///< a folder of pictures, or a file of their numbers
  std::vector<std::string> ours;  ///< likewise, or scenarios and worlds
  ViewKind view = ViewKind::kSide;
  int images = 24;  ///< of each scenario or world
  int width = 752;  ///< px, of a folder's pictures and of ours; a file has its own
  std::int64_t seed = 1;
  std::vector<Override> overrides;  ///< of scenarios and worlds
  std::filesystem::path save;       ///< for the photographs' numbers; empty: not kept
  std::filesystem::path out;        ///< folder for page, table and pictures
  std::filesystem::path fit;        ///< a randomisation to search in; empty: none
  int draws = 40;
  int fit_images = 6;  ///< of each draw
  int threads = 1;
  Machine machine;
  std::function<void(const std::string&)> told;  ///< of progress, a line each
};

/// Compares, and writes realism.html, realism.json and the pictures of ours. Returns the tables.
std::string measure_realism(const RealismRequest& request, const Catalogue& catalogue);

/// Searches in a randomisation of the scenario for settings whose pictures lie nearest to the
/// photographs, and writes what is left of it as fitted.yaml. Returns what was found, measured on
/// draws that the search did not have.
std::string fit_realism(const RealismRequest& request, const Catalogue& catalogue);

}  // namespace vinebench::harness
