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

/// One thing in an image, or a plant's part of one category.
struct ThingLabel {
  Category category = Category::kBunch;
  std::int32_t number = 0;   ///< of RenderedImage::instances; for a plant, of the whole
  std::int32_t segment = 0;  ///< its pixels' value in the panoptic image; 0 for a whole plant
  Runs mask;
  /// Visible share of its surface points within the image; absent for parts of plants without their
  /// own points (trunk, cane, leaf) and for the rover.
  std::optional<double> visibility;
  std::optional<double> truncation;  ///< share of it outside the image; absent likewise
};

/// Pixels of uncountable categories.
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

/// Splits an image's labels and instances into things and stuff. Truncation and visibility are
/// measured at points of the thing's surface (SceneIndex::points): the share of points outside the
/// image, and of the others the share whose pixel shows the thing. In wind, the points of still air
/// are used.
ImageLabels label_things(const TruthView& view, const SceneIndex& scene);

}  // namespace vinebench::harness
