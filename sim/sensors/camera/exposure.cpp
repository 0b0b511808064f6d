// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/camera/exposure.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

constexpr double kDarkest = 1;  // grey levels; a black image must not ask for endless light

}  // namespace

ExposureControl::ExposureControl(const ExposureConfig& config, const Rig& rig)
    : config_(config),
      step_(config.time_constant > 0 ? 1 - std::exp(-1 / (rig.rate_hz * config.time_constant)) : 1),
      group_of_(rig.cameras.size(), rig.cameras.size()) {
  const Exposure first{config.time.value_or(kNominalTime), config.metered() ? 0 : config.gain_db};
  const auto add = [&](std::size_t camera, std::size_t group) {
    if (group_of_[camera] < rig.cameras.size()) return;  // in another pair already
    group_of_[camera] = group;
    groups_[group].cameras.push_back(camera);
  };
  for (const StereoPair& pair : rig.stereo_pairs) {
    groups_.push_back({{}, first});
    add(static_cast<std::size_t>(pair.left), groups_.size() - 1);
    add(static_cast<std::size_t>(pair.right), groups_.size() - 1);
  }
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
    groups_.push_back({{}, first});
    add(camera, groups_.size() - 1);
  }
}

void ExposureControl::observe(const std::vector<cv::Mat>& images) {
  if (!config_.automatic) return;
  for (Group& group : groups_) {
    double sum = 0;
    int delivered = 0;
    for (const std::size_t camera : group.cameras) {
      if (images[camera].empty()) continue;
      sum += mean_brightness(images[camera]);
      ++delivered;
    }
    if (delivered > 0) steer(group, sum / delivered, step_);
  }
}

void ExposureControl::meter(const Take& take) {
  if (!config_.metered()) return;
  for (Group& group : groups_) {
    if (group.cameras.empty()) continue;
    for (int look = 0; look < kLooks; ++look) {
      steer(group, mean_brightness(take(group.cameras.front())), 1);
    }
    group.exposure.gain_db += config_.gain_db;
  }
}

void ExposureControl::steer(Group& group, double brightness, double step) const {
  Exposure& now = group.exposure;
  const double wanted =
      light_of_code(config_.target) / light_of_code(std::max(brightness, kDarkest));
  const double product = now.time * now.gain() * std::pow(wanted, step);
  now.time = std::clamp(product, config_.min_time, config_.max_time);
  now.gain_db = std::clamp(20 * std::log10(product / now.time), 0.0, config_.max_gain_db);
}

double metered_factor(const std::function<cv::Mat(double factor)>& draw) {
  const ExposureConfig config;
  Rig rig;
  rig.cameras.resize(1);
  ExposureControl control(config, rig);
  const auto factor = [&] { return control.of(0).factor(config.reference_time); };
  control.meter([&](std::size_t) { return draw(factor()); });
  return factor();
}

double mean_brightness(const cv::Mat& image) {
  std::uint64_t sum = 0;
  std::uint64_t count = 0;
  for (int y = 0; y < image.rows; y += 4) {
    const auto* row = image.ptr<std::uint8_t>(y);
    const auto values = static_cast<std::size_t>(image.cols) * image.elemSize();
    sum = std::accumulate(row, row + values, sum);
    count += values;
  }
  return count > 0 ? static_cast<double>(sum) / static_cast<double>(count) : 0;
}

}  // namespace vinebench::sim
