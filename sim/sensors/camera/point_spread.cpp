// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/camera/point_spread.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace vinebench::sim {
namespace {

constexpr int kChannels = 3;

float light_of(float value) {
  return value;
}
float light_of(std::uint8_t code) {
  return static_cast<float>(code) * static_cast<float>(code);
}
void set_light(float light, float& value) {
  value = light;
}
void set_light(float light, std::uint8_t& code) {
  code = static_cast<std::uint8_t>(std::sqrt(light) + 0.5f);
}

template <class Value>
void spread(cv::Mat& image, float side) {
  const int n = kChannels * image.cols;
  const float middle = 1 - 2 * side;
  // Three rows' light as it was, and their mean with a pixel more at either end.
  std::vector<float> above(static_cast<std::size_t>(n)), here(above), below(above);
  std::vector<float> mean(static_cast<std::size_t>(n + 2 * kChannels));
  const auto read = [&](int y, std::vector<float>& light) {
    const Value* row = image.ptr<Value>(std::min(y, image.rows - 1));
    for (int x = 0; x < n; ++x) light[x] = light_of(row[x]);
  };
  read(0, above);
  here = above;
  for (int y = 0; y < image.rows; ++y) {
    read(y + 1, below);
    float* inner = mean.data() + kChannels;
    for (int x = 0; x < n; ++x) inner[x] = middle * here[x] + side * (above[x] + below[x]);
    std::copy_n(inner, kChannels, mean.data());
    std::copy_n(inner + n - kChannels, kChannels, inner + n);
    Value* row = image.ptr<Value>(y);
    for (int x = 0; x < n; ++x) {
      set_light(middle * inner[x] + side * (inner[x - kChannels] + inner[x + kChannels]), row[x]);
    }
    std::swap(above, here);
    std::swap(here, below);
  }
}

}  // namespace

void spread_points(cv::Mat& image, double sigma) {
  if (sigma <= 0 || image.empty()) return;
  const auto side = static_cast<float>(sigma * sigma / 2);
  if (image.depth() == CV_8U) {
    spread<std::uint8_t>(image, side);
  } else {
    spread<float>(image, side);
  }
}

}  // namespace vinebench::sim
