// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "core/geometry/camera.h"
#include "sim/render/render_engine.h"
#include "sim/scene/scene.h"
#include "sim/sensors/effects/effect.h"

namespace vinebench::sim {

/// Light that a sun in the image scatters inside the lens: a saturated disc, a bloom around it
/// and a veil over everything, by the share of the disc that no leaf covers. `rgb` CV_8UC3 and
/// `labels` CV_8UC1 of one image; `towards_sun` in the camera's frame. Nothing happens where the
/// sun is not in the image.
void add_glare(cv::Mat& rgb, const cv::Mat& labels, const PinholeCamera& camera,
               const Eigen::Vector3d& towards_sun, const Light& light, double exposure);

/// Null where the scene has no sun to glare.
std::unique_ptr<ViewEffect> make_glare(const EffectInputs& inputs);

/// The engine's view with the glare of a clean lens, for images that no camera sensor takes.
RenderedImage render_with_glare(RenderEngine& engine, const Light& light,
                                const PinholeCamera& camera, const Pose& T_world_cam,
                                const RenderRequest& request);

}  // namespace vinebench::sim
