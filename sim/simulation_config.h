// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/config/config_field.h"
#include "sim/render/renderer_config.h"
#include "sim/rover/route.h"
#include "sim/rover/rover.h"
#include "sim/sensors/sensors.h"
#include "sim/world/world.h"

namespace vinebench::sim {

struct SimulationConfig {
  WorldConfig world;
  RoverConfig rover;
  RouteConfig route;
  RendererConfig renderer;
  SensorsConfig sensors;
  std::optional<double> duration;  ///< s; the whole route if absent
  template <class Archive>
  void serialize(Archive& archive) {
    archive("world", world);
    archive("rover", rover);
    archive("route", route);
    archive("renderer", renderer);
    archive("sensors", sensors);
    archive("duration", duration, Range::positive());
  }
};

}  // namespace vinebench::sim
