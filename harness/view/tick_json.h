// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "core/geometry/rig.h"
#include "harness/report/tick_events.h"

namespace vinebench::harness {

/// Frames of a run as a page draws them while it goes on (`LiveTick` of harness/page/web/types.ts):
/// poses in the world, where the first estimated one lies on the true one; what later corrections
/// move is not moved again.
class TickJson {
 public:
  TickJson(const Rig& rig, double box_share)
      : cameras_(rig.cameras.size()), events_(rig, box_share) {}

  /// Of the next tick.
  nlohmann::ordered_json of(const Tick& tick);

 private:
  std::size_t cameras_;
  TickEvents events_;
  std::optional<Pose> T_world_map_;
};

}  // namespace vinebench::harness
