// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/config/override.h"
#include "harness/machine.h"
#include "sim/render/renderer_config.h"

namespace vinebench::harness {

/// A view of a world to be rendered. Poses are "X,Y,Z,YAW[,PITCH]" in m and degrees (parse_view());
/// files whose name is empty are not written.
struct ViewRequest {
  std::string world;
  std::string pose;
  std::string camera;
  std::string rig;
  std::string out;
  std::string labels;
  std::string depth;
  std::string instances;
  std::string normals;
  std::string flow;
  std::string flow_to;
  std::string flow_visible;
  std::string rover;
  std::string rover_to;
  std::string rover_file;  ///< required with `rover`
  std::string disparity;
  std::string export_to;            ///< folder for what another renderer needs of the view
  double baseline = 0.12;           ///< m
  std::vector<Override> overrides;  ///< of the world
  std::int64_t seed = 1;
  bool turntable = false;  ///< eight views from all round on one sheet, without a pose
  sim::RenderQuality quality = sim::RenderQuality::kFast;
  Machine machine;
};

/// Renders the view and writes the files that are named. Throws Error for bad requests and files.
void render_view(const ViewRequest& request);

}  // namespace vinebench::harness
