// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/make_world.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/files/files.h"
#include "core/util/error.h"
#include "sim/config_files.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {

std::string make_world(const WorldRequest& request) {
  const std::filesystem::path file =
      request.out.empty() ? request.recipe.name + ".yaml" : request.out;
  const std::string text = sim::format_world(request.recipe);
  std::error_code problem;
  if (!request.force && std::filesystem::exists(file, problem)) {
    fail("{} exists; give --force to overwrite it", file.string());
  }
  write_file_atomically(file, text);
  const sim::WorldLayout layout = sim::lay_out(sim::load_world(file));
  return fmt::format("{}: {} rows, {} vines, {} posts, {} tags\n", file.string(),
                     layout.rows.size(), layout.vines.size(), layout.posts.size(),
                     layout.tags.size());
}

}  // namespace vinebench::harness
