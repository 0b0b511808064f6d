// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/recording.h"

#include "core/util/error.h"
#include "harness/datasets/reading/kalibr_chain.h"

namespace vinebench::harness {

Rig load_rig_for(const std::filesystem::path& file, std::size_t cameras) {
  Rig rig = is_kalibr_chain(file) ? load_kalibr_chain(file) : load_rig(file);
  if (rig.cameras.size() > cameras) {
    fail("{}: rig '{}' has {} cameras, the recording has {}", file.string(), rig.name,
         rig.cameras.size(), cameras);
  }
  return rig;
}

}  // namespace vinebench::harness
