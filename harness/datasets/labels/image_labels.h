// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/truth/scene_index.h"
#include "core/truth/truth_images.h"
#include "harness/datasets/labels/label_table.h"
#include "harness/datasets/labels/mask_rle.h"

namespace vinebench::harness {

/// One thing of an image, or what of a category a plant has there.
struct ThingLabel {
  Category category = Category::kBunch;
  std::int32_t number = 0;   ///< of RenderedImage::instances; of a plant its whole's
  std::int32_t segment = 0;  ///< its pixels' value in the panoptic image; 0 of a whole plant
  Runs mask;
  /// Share of its outline within the image that it shows itself in; absent for parts of plants
  /// that have no outline of their own (trunk, cane, leaf) and for the rover.
  std::optional<double> visibility;
  std::optional<double> truncation;  ///< share of it outside the image; absent likewise
};

/// Pixels of no countable thing.
struct StuffLabel {
  Category category = Category::kSky;
  std::int32_t segment = 0;
  Runs mask;
};

struct ImageLabels {
  std::vector<ThingLabel> things;  ///< by category, then number
  std::vector<StuffLabel> stuff;   ///< by category
  cv::Mat segments;                ///< CV_32SC1: panoptic ids; every pixel has one
};

/// Takes an image's labels and instances apart. Visibility and truncation are measured at points
/// of the thing's surface (SceneIndex::points): the share of those that fall outside the image,
/// and of the others the share whose pixel shows the thing. In wind they are those of still air.
ImageLabels label_things(const TruthView& view, const SceneIndex& scene);

}  // namespace vinebench::harness
