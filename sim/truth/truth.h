// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"
#include "core/truth/occlusion.h"
#include "core/truth/site.h"
#include "sim/world/world.h"

namespace vinebench::sim {

/// Share of pixels (0 to 1) that show `wanted` in an image of labels (CV_8UC1 of Label).
double label_share(const cv::Mat& labels, Label wanted);

/// The shares of an image of labels that occluders of these classes cover.
Occlusion occlusion_in(const cv::Mat& labels, const std::vector<OccluderClass>& classes);

/// The classes of a world's occluders, each once, in the order of OccluderClass.
std::vector<OccluderClass> occluder_classes(const WorldConfig& world);

/// Whether a tag's black square is completely in the image, at least `min_side` px large along its
/// shortest side, with its centre and corners unoccluded by the labels. A tag seen from behind or
/// from more than 75 degrees off its normal does not count.
bool is_tag_visible(const WorldTag& tag, const PinholeCamera& camera, const Pose& T_world_cam,
                    const cv::Mat& labels, double min_side = 24);

}  // namespace vinebench::sim
