// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/labels/truth_colours.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/files/files.h"
#include "core/util/random.h"
#include "harness/datasets/files/image_codec.h"
#include "harness/datasets/files/image_file.h"

namespace vinebench::harness {
namespace {

/// Length that 99 % of the known flow stays below, px.
double long_flow(const cv::Mat& flow) {
  std::vector<double> lengths;
  for (int y = 0; y < flow.rows; ++y) {
    for (int x = 0; x < flow.cols; ++x) {
      const auto& f = flow.at<cv::Vec2f>(y, x);
      if (has_flow(f)) lengths.push_back(cv::norm(f));
    }
  }
  if (lengths.empty()) return 1;
  const auto at = lengths.begin() + static_cast<std::ptrdiff_t>((lengths.size() - 1) * 99 / 100);
  std::nth_element(lengths.begin(), at, lengths.end());
  return std::max(*at, 1e-6);
}

}  // namespace

cv::Vec3b instance_colour(std::int32_t number) {
  if (number == 0) return {0, 0, 0};
  const RandomStream random(static_cast<std::uint64_t>(number), "instance colour");
  cv::Vec3b colour;
  for (int i = 0; i < 3; ++i) {
    colour[i] = static_cast<std::uint8_t>(random.uniform(static_cast<std::uint64_t>(i), 50, 255));
  }
  return colour;
}

cv::Mat colour_instances(const cv::Mat& instances) {
  cv::Mat colours(instances.size(), CV_8UC3);
  std::int32_t last = 0;
  cv::Vec3b colour(0, 0, 0);
  for (int y = 0; y < instances.rows; ++y) {
    for (int x = 0; x < instances.cols; ++x) {
      const std::int32_t number = instances.at<std::int32_t>(y, x);
      if (number != last) colour = instance_colour(last = number);
      colours.at<cv::Vec3b>(y, x) = colour;
    }
  }
  return colours;
}

/// In two passes, of which the first has no branch.
cv::Mat colour_normals(const cv::Mat& normals) {
  constexpr float kWhole = 12582912.0f;  // 1.5 * 2^23: adding it rounds to whole numbers
  cv::Mat colours(normals.size(), CV_8UC3);
  std::vector<float> signs(3 * static_cast<std::size_t>(normals.cols), -1.0f);
  for (std::size_t i = 0; i < signs.size(); i += 3) signs[i] = 1;
  const float* sign = signs.data();
  for (int y = 0; y < normals.rows; ++y) {
    const auto* n = normals.ptr<float>(y);
    auto* code = colours.ptr<std::uint8_t>(y);
    for (int i = 0; i < 3 * normals.cols; ++i) {
      const float rounded = (127.5f * (1 + sign[i] * n[i]) + kWhole) - kWhole;
      code[i] = static_cast<std::uint8_t>(static_cast<int>(rounded < 0     ? 0
                                                           : rounded > 255 ? 255.0f
                                                                           : rounded));
    }
    for (int i = 0; i < 3 * normals.cols; i += 3) {
      if (n[i] == 0 && n[i + 1] == 0 && n[i + 2] == 0) std::fill_n(code + i, 3, std::uint8_t{0});
    }
  }
  return colours;
}

cv::Mat colour_flow(const cv::Mat& flow) {
  const double longest = long_flow(flow);
  cv::Mat hsv(flow.size(), CV_32FC3);  // degrees, shares
  for (int y = 0; y < flow.rows; ++y) {
    for (int x = 0; x < flow.cols; ++x) {
      const auto& f = flow.at<cv::Vec2f>(y, x);
      const bool known = has_flow(f);
      const double angle = known ? std::atan2(f[1], f[0]) * 180 / std::numbers::pi : 0;
      const double share = known ? std::min(1.0, cv::norm(f) / longest) : 0;
      hsv.at<cv::Vec3f>(y, x) = {static_cast<float>(angle < 0 ? angle + 360 : angle),
                                 static_cast<float>(share), known ? 1.0f : 0.0f};
    }
  }
  cv::Mat rgb, colours;
  cv::cvtColor(hsv, rgb, cv::COLOR_HSV2RGB);
  rgb.convertTo(colours, CV_8UC3, 255);
  return colours;
}

void write_flow(const std::filesystem::path& file, const cv::Mat& flow) {
  if (file.extension() == ".flo") {
    write_file_atomically(file, encode_flo(flow));
  } else {
    write_image(file, colour_flow(flow));
  }
}

cv::Mat kitti_disparity(const cv::Mat& disparity) {
  cv::Mat codes;
  disparity.convertTo(codes, CV_16U, 256);
  return codes;
}

}  // namespace vinebench::harness
