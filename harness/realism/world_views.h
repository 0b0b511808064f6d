// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/files/cache_folder.h"
#include "harness/realism/picture_set.h"
#include "sim/simulation.h"

namespace vinebench::harness {

/// How photographs of vineyards are taken.
enum class ViewKind {
  kSide,   ///< across the aisle to a row, from 0.9 to 1.8 m
  kAhead,  ///< from the aisle's middle along the rows
};

/// Pictures to take of a simulated vineyard.
struct ViewsRequest {
  sim::SimulationConfig simulation;  ///< its world, sensors and renderer
  ViewKind kind = ViewKind::kSide;
  int count = 24;
  int width = 752;  ///< px; the height is 480 / 752 of it
  std::uint64_t seed = 1;
};

/// A view's camera: x right, y down, z ahead; px.
struct View {
  PinholeCamera camera;
  Pose T_world_cam;
};

/// Places and directions by seed, spread over all rows. The lens from the side is that of most
/// photographs, a telephone's: 26 mm on film of 36 mm, 0.72 of the width. Ahead it is that of the
/// default rig's pairs, 263 px of 752.
std::vector<View> draw_views(const ViewsRequest& request);

/// Takes the pictures (CV_8UC3, RGB) with all effects of the sensors' cameras. With automatic
/// exposure each is taken when it has settled.
std::vector<cv::Mat> take_pictures(const ViewsRequest& request, const CacheFolder& cache);

/// Takes and measures them, each a group of its own; `keep` is a folder for the pictures, or empty.
PictureSet measure_views(const ViewsRequest& request, const CacheFolder& cache, WorkerPool& pool,
                         const std::filesystem::path& keep = {});

}  // namespace vinebench::harness
