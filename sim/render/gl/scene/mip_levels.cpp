// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/mip_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

std::array<float, 256> lights_of_bytes() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(light_of_code(static_cast<double>(i)));
  }
  return table;
}

/// The light from which on a byte is the next one, halfway between both.
std::array<float, 255> byte_limits() {
  std::array<float, 255> limits{};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    limits[i] = static_cast<float>(light_of_code(static_cast<double>(i) + 0.5));
  }
  return limits;
}

/// Finds the byte of a light: from the least one of the light's cell on, which leaves few limits to
/// compare with.
class ByteTable {
 public:
  ByteTable() {
    for (int cell = 0; cell < kCells; ++cell) {
      const float least = static_cast<float>(cell) / kCells;
      least_[static_cast<std::size_t>(cell)] = static_cast<std::uint8_t>(
          std::upper_bound(limits_.begin(), limits_.end(), least) - limits_.begin());
    }
  }

  std::uint8_t byte_of(float light) const {
    const auto cell = static_cast<int>(std::clamp(light * kCells, 0.0f, kCells - 1.0f));
    std::size_t byte = least_[static_cast<std::size_t>(cell)];
    while (byte < limits_.size() && limits_[byte] <= light) ++byte;
    return static_cast<std::uint8_t>(byte);
  }

 private:
  static constexpr int kCells = 1024;
  std::array<float, 255> limits_ = byte_limits();
  std::array<std::uint8_t, kCells> least_;
};

/// Linear light, weighted by alpha so that a cut-out's background does not bleed into its edge.
cv::Mat to_light(const cv::Mat& rgba, bool cutout) {
  static const std::array<float, 256> lights = lights_of_bytes();
  cv::Mat light(rgba.size(), CV_32FC4);
  for (int y = 0; y < rgba.rows; ++y) {
    for (int x = 0; x < rgba.cols; ++x) {
      const cv::Vec4b& from = rgba.at<cv::Vec4b>(y, x);
      const float alpha = from[3] / 255.0f;
      const float weight = cutout ? std::max(alpha, 1e-3f) : 1.0f;
      cv::Vec4f& to = light.at<cv::Vec4f>(y, x);
      for (int c = 0; c < 3; ++c) to[c] = weight * lights[from[c]];
      to[3] = cutout ? weight : alpha;
    }
  }
  return light;
}

cv::Mat to_bytes(const cv::Mat& light, bool cutout, float alpha_scale) {
  static const ByteTable table;
  cv::Mat rgba(light.size(), CV_8UC4);
  for (int y = 0; y < light.rows; ++y) {
    for (int x = 0; x < light.cols; ++x) {
      const cv::Vec4f& from = light.at<cv::Vec4f>(y, x);
      cv::Vec4b& to = rgba.at<cv::Vec4b>(y, x);
      const float weight = cutout ? from[3] : 1.0f;
      for (int c = 0; c < 3; ++c) to[c] = table.byte_of(from[c] / weight);
      to[3] = cv::saturate_cast<std::uint8_t>(255.0f * alpha_scale * from[3]);
    }
  }
  return rgba;
}

/// Deviation from the mean of 3 x 3 texels.
cv::Mat fine_part(const cv::Mat& light) {
  cv::Mat mean;
  cv::blur(light, mean, {3, 3});
  return light - mean;
}

cv::Mat green_of(const cv::Mat& light) {
  cv::Mat green;
  cv::extractChannel(light, green, 1);
  return green;
}

/// Of one channel's fine part.
double deviation(const cv::Mat& fine) {
  double sum = 0;
  for (int y = 0; y < fine.rows; ++y) {
    const auto* row = fine.ptr<float>(y);
    for (int x = 0; x < fine.cols; ++x) {
      sum += static_cast<double>(row[x]) * static_cast<double>(row[x]);
    }
  }
  return std::sqrt(sum / static_cast<double>(fine.total()));
}

double contrast_of(const cv::Mat& light) {
  return deviation(fine_part(green_of(light)));
}

/// Light with its fine part's deviation raised to that, of colours alone.
cv::Mat roughened(const cv::Mat& light, double wanted) {
  const cv::Mat fine = fine_part(light);
  const double factor =
      std::clamp(wanted / std::max(1e-6, deviation(green_of(fine))), 1.0, kMostRaised);
  cv::Mat rough = light.clone();
  for (int y = 0; y < rough.rows; ++y) {
    for (int x = 0; x < rough.cols; ++x) {
      cv::Vec4f& to = rough.at<cv::Vec4f>(y, x);
      const cv::Vec4f& by = fine.at<cv::Vec4f>(y, x);
      for (int c = 0; c < 3; ++c) {
        to[c] = std::max(0.0f, to[c] + static_cast<float>(factor - 1) * by[c]);
      }
    }
  }
  return rough;
}

/// The factor that brings the share of alphas of at least one half to `coverage`.
float coverage_scale(const cv::Mat& light, double coverage) {
  std::vector<float> alphas;
  alphas.reserve(light.total());
  for (auto it = light.begin<cv::Vec4f>(); it != light.end<cv::Vec4f>(); ++it) {
    alphas.push_back((*it)[3]);
  }
  const auto kept = static_cast<std::size_t>(std::lround(coverage * alphas.size()));
  if (kept == 0) return 1.0f;
  std::nth_element(alphas.begin(), alphas.begin() + (kept - 1), alphas.end(), std::greater<>());
  return std::clamp(0.505f / std::max(alphas[kept - 1], 1e-3f), 0.25f, 4.0f);
}

}  // namespace

double alpha_coverage(const cv::Mat& rgba) {
  const auto passes = [](const cv::Vec4b& p) { return p[3] >= 128; };
  return static_cast<double>(
             std::count_if(rgba.begin<cv::Vec4b>(), rgba.end<cv::Vec4b>(), passes)) /
         static_cast<double>(rgba.total());
}

std::vector<cv::Mat> mip_levels(const cv::Mat& rgba, bool cutout) {
  std::vector<cv::Mat> levels{rgba.clone()};
  const double coverage = cutout ? alpha_coverage(rgba) : 0;
  cv::Mat light = to_light(rgba, cutout);
  while (light.cols > 1 || light.rows > 1) {
    const cv::Size half(std::max(1, light.cols / 2), std::max(1, light.rows / 2));
    cv::resize(light, light, half, 0, 0, cv::INTER_AREA);
    levels.push_back(to_bytes(light, cutout, cutout ? coverage_scale(light, coverage) : 1.0f));
  }
  return levels;
}

double near_contrast(const cv::Mat& rgba) {
  return contrast_of(to_light(rgba, false));
}

std::vector<cv::Mat> rough_mip_levels(const cv::Mat& rgba) {
  std::vector<cv::Mat> levels{rgba.clone()};
  cv::Mat light = to_light(rgba, false);
  const double wanted = kKeptContrast * contrast_of(light);
  while (light.cols > 1 || light.rows > 1) {
    const cv::Size half(std::max(1, light.cols / 2), std::max(1, light.rows / 2));
    cv::resize(light, light, half, 0, 0, cv::INTER_AREA);
    levels.push_back(to_bytes(roughened(light, wanted), false, 1.0f));
  }
  return levels;
}

}  // namespace vinebench::sim
