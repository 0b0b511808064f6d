// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/camera/camera_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "sim/sensors/camera/light.h"

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

/// Puts a band of rows into a whole image, begun where it is empty.
void put_rows(const cv::Mat& band, int top, cv::Size whole, cv::Mat& image) {
  if (band.empty()) return;
  if (image.empty()) image.create(whole, band.type());
  band.copyTo(image.rowRange(top, top + band.rows));
}

}  // namespace

CameraSensor::CameraSensor(const CameraSensorConfig& config, const RigCamera& camera, int index,
                           std::uint64_t seed)
    : config_(config),
      camera_(camera),
      index_(index),
      seed_(seed),
      bands_(make_lens_bands(camera.model, config.readout_time > 0 ? config.readout_bands : 1)),
      photon_transfer_(config.noise, config.gamma) {
  const cv::Size size(camera.model.width, camera.model.height);
  for (const LensDirtConfig& dirt : config.dirt) {
    if (dirt.scope.applies_to(camera.name)) {
      covers_.push_back(make_lens_dirt(dirt, size, seed, index));
    }
  }
  for (const LensLeafConfig& leaf : config.leaves) {
    if (leaf.scope.applies_to(camera.name)) covers_.push_back(make_lens_leaf(leaf, size));
  }
  if (!config.vignetting.is_off()) vignette_ = vignette(config.vignetting, camera.model);
  if (!config.fixed_pattern.is_off()) {
    fixed_pattern_.emplace(config.fixed_pattern, size, seed, index);
  }
}

Stamp CameraSensor::truth_instant(const Shot& shot) const {
  const int count = config_.blur_subframes;
  return shot.instant + subframe_offset(count / 2, count, shot.exposure.time);
}

RenderedImage CameraSensor::capture(const Shot& shot, const PoseAt& T_world_body,
                                    const Render& render) {
  RenderedImage image = expose(shot, T_world_body, render);
  develop(image.rgb, shot);
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
  Renderer::Request colours;
  colours.exposure = shot.exposure.factor(config_.exposure.reference_time);
  Renderer::Request everything = shot.request;
  everything.exposure = colours.exposure;
  RenderedImage result;
  cv::Mat light;
  for (int i = 0; i < count; ++i) {
    const Stamp stamp = middle + subframe_offset(i, count, shot.exposure.time);
    const Pose T_world_rover = T_world_body(stamp);
    Renderer::Request& request = i == count / 2 ? everything : colours;
    request.T_world_rover = T_world_rover;
    request.time = to_seconds(stamp);
    RenderedImage drawn = render(band.view, T_world_rover * camera_.T_body_cam, request);
    if (count > 1) add_light(drawn.rgb, 1.0f / static_cast<float>(count), light);
    if (i == count / 2) result = std::move(drawn);
  }
  if (count > 1) result.rgb = light;
  for (const Layer layer : kLayers) {
    result.*layer = band.resample(result.*layer, layer != &RenderedImage::rgb);
  }
  return result;
}

/// From the middle row's exposure to that of the band's middle.
Stamp CameraSensor::readout_delay(const LensBand& band) const {
  const double middle = band.top + 0.5 * (band.rows - 1);
  const double last = camera_.model.height - 1;
  return last > 0 ? from_seconds((middle / last - 0.5) * config_.readout_time) : 0;
}

bool CameraSensor::changes_light(Stamp instant) const {
  return !vignette_.empty() || fixed_pattern_ ||
         std::ranges::any_of(covers_,
                             [&](const LensCover& c) { return c.scope.is_active(instant); });
}

void CameraSensor::develop(cv::Mat& image, const Shot& shot) {
  if (image.depth() == CV_8U && changes_light(shot.instant)) image = to_light(image);
  if (image.depth() == CV_32F) {
    dim_and_cover(image, shot);
    image = to_codes(image);
  }
  const bool filters_colours = config_.bayer != BayerPattern::kNone;
  if (filters_colours) image = mosaic(image, config_.bayer);
  if (!photon_transfer_.is_identity()) {
    photon_transfer_.set_gain(shot.exposure.gain_db);
    photon_transfer_.apply(image, RandomStream(seed_, "sensor.noise." + std::to_string(index_),
                                               static_cast<std::uint64_t>(shot.frame)));
  }
  if (filters_colours) image = demosaic(image, config_.bayer);
}

void CameraSensor::dim_and_cover(cv::Mat& light, const Shot& shot) const {
  for (const LensCover& cover : covers_) {
    if (cover.scope.is_active(shot.instant)) cover.apply(light);
  }
  if (!vignette_.empty()) {
    for (int y = 0; y < light.rows; ++y) {
      auto* row = light.ptr<cv::Vec3f>(y);
      const auto* share = vignette_.ptr<float>(y);
      for (int x = 0; x < light.cols; ++x) row[x] *= share[x];
    }
  }
  if (fixed_pattern_) {
    const double white = config_.noise.full_well / std::pow(10.0, shot.exposure.gain_db / 20);
    fixed_pattern_->apply(light, shot.exposure.time, white);
  }
}

}  // namespace vinebench::sim
