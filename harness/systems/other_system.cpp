// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/other_system.h"

#include "core/util/error.h"
#include "harness/systems/external_slam.h"
#include "harness/systems/plugin_slam.h"

namespace vinebench::harness {

void expect_no_code(const SlamChoice& choice, const std::filesystem::path& origin) {
  const std::string where = origin.empty() ? "" : origin.string() + ": ";
  if (choice.plugin) {
    fail("{}slam.plugin: is code, {}; --untrusted allows none", where,
         choice.plugin->library.string());
  }
  if (choice.external) {
    fail("{}slam.external: is a program, {}; --untrusted allows none", where,
         choice.external->program.string());
  }
}

std::unique_ptr<SlamSystem> make_other_system(const SlamChoice& choice, const Rig& rig,
                                              const RecordingNotes& notes, int threads,
                                              const OtherSystemPlaces& places) {
  if (choice.plugin) {
    return load_plugin_slam(*choice.plugin, rig, notes.tags, choice.dead_reckoning.wheels, threads,
                            {places.plugin_host, places.stopped});
  }
  return make_external_slam(choice.external.value(), notes, places.folder, places.stopped);
}

}  // namespace vinebench::harness
