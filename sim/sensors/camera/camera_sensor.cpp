// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/camera/camera_sensor.h"

#include <array>
#include <utility>

#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

using Layer = cv::Mat RenderedImage::*;
constexpr std::array<Layer, 6> kLayers{&RenderedImage::rgb,     &RenderedImage::labels,
                                       &RenderedImage::depth,   &RenderedImage::instances,
                                       &RenderedImage::normals, &RenderedImage::motion};

/// Instant of a sub-frame, off the middle of the exposure.
Stamp subframe_offset(int subframe, int count, double exposure_time) {
  return from_seconds(((subframe + 0.5) / count - 0.5) * exposure_time);
}

/// Puts a band of rows into a whole image, begun where it is empty. A band without motion has none.
void put_rows(const cv::Mat& band, int top, cv::Size whole, cv::Mat& image) {
  if (band.empty()) return;
  if (image.empty()) image = cv::Mat(whole, band.type(), cv::Scalar::all(0));
  band.copyTo(image.rowRange(top, top + band.rows));
}

}  // namespace

CameraSensor::CameraSensor(const CameraSensorConfig& config, const RigCamera& camera, int index,
                           std::uint64_t seed, const Light& light)
    : config_(config),
      camera_(camera),
      bands_(make_lens_bands(camera.model, config.readout_time > 0 ? config.readout_bands : 1)),
      effects_(make_effects(config, {camera, index, seed, light})) {}

Stamp CameraSensor::truth_instant(const Shot& shot) const {
  const int count = config_.blur_subframes;
  return shot.instant + subframe_offset(count / 2, count, shot.exposure.time);
}

RenderedImage CameraSensor::capture(const Shot& shot, const PoseAt& T_world_body,
                                    const Render& render) {
  RenderedImage image = expose(shot, T_world_body, render);
  spread_points(image.rgb, config_.point_spread);
  effects_.develop(image.rgb, shot);
  return image;
}

/// Colours are codes, or light where they are a mean.
RenderedImage CameraSensor::expose(const Shot& shot, const PoseAt& T_world_body,
                                   const Render& render) const {
  if (bands_.size() == 1) return expose_band(0, shot, T_world_body, render);
  const cv::Size size(camera_.model.width, camera_.model.height);
  RenderedImage whole;
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    const RenderedImage part = expose_band(i, shot, T_world_body, render);
    for (const Layer layer : kLayers) {
      put_rows(part.*layer, bands_[i].top, size, whole.*layer);
    }
  }
  return whole;
}

RenderedImage CameraSensor::expose_band(std::size_t index, const Shot& shot,
                                        const PoseAt& T_world_body, const Render& render) const {
  const LensBand& band = bands_[index];
  const int count = config_.blur_subframes;
  const Stamp middle = shot.instant + readout_delay(band);
  RenderRequest colours;
  colours.exposure = shot.exposure.factor(config_.exposure.reference_time);
  RenderRequest everything = shot.request;
  everything.exposure = colours.exposure;
  RenderedImage result;
  cv::Mat light;
  for (int i = 0; i < count; ++i) {
    const Stamp stamp = middle + subframe_offset(i, count, shot.exposure.time);
    RenderRequest& request = i == count / 2 ? everything : colours;
    request.time = to_seconds(stamp);
    RenderedImage drawn = draw(band, T_world_body(stamp), request, render);
    if (count > 1) add_light(drawn.rgb, 1.0f / static_cast<float>(count), light);
    if (i == count / 2) result = std::move(drawn);
  }
  if (count > 1) result.rgb = light;
  for (const Layer layer : kLayers) {
    result.*layer = band.resample(result.*layer, layer != &RenderedImage::rgb);
  }
  return result;
}

RenderedImage CameraSensor::draw(const LensBand& band, const Pose& T_world_rover,
                                 const RenderRequest& request, const Render& render) const {
  const Pose T_world_cam = T_world_rover * camera_.T_body_cam;
  const DrawnView view{band.view, T_world_cam, request.exposure};
  RenderRequest asked = request;
  asked.T_world_rover = T_world_rover;
  asked.labels |= effects_.wants_labels(view);
  const bool blurred = config_.depth_of_field.aperture > 0;
  asked.depth |= blurred;
  RenderedImage drawn = render(band.view, T_world_cam, asked);
  if (blurred) {
    const double focal = 0.5 * (band.view.fx + band.view.fy);
    blur_by_depth(drawn.rgb, drawn.depth, focal, config_.depth_of_field);
    if (!request.depth) drawn.depth.release();
  }
  effects_.apply_to_view(drawn, view);
  if (!request.labels) drawn.labels.release();
  return drawn;
}

/// From the middle row's exposure to that of the band's middle.
Stamp CameraSensor::readout_delay(const LensBand& band) const {
  const double middle = band.top + 0.5 * (band.rows - 1);
  const double last = camera_.model.height - 1;
  return last > 0 ? from_seconds((middle / last - 0.5) * config_.readout_time) : 0;
}

}  // namespace vinebench::sim
