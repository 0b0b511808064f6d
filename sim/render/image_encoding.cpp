// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/image_encoding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace vinebench::sim {
namespace {

using LightTable = std::array<float, 256>;

LightTable make_light_table() {
  LightTable table{};
  for (std::size_t code = 0; code < table.size(); ++code) {
    table[code] = static_cast<float>(light_of_code(static_cast<double>(code)));
  }
  return table;
}

const LightTable& light_table() {
  static const LightTable table = make_light_table();
  return table;
}

/// Codes by the square root of light, where they lie almost evenly.
constexpr int kRoots = 8192;
using CodeTable = std::array<std::uint8_t, kRoots + 1>;

CodeTable make_code_table() {
  CodeTable table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double root = static_cast<double>(i) / kRoots;
    table[i] = static_cast<std::uint8_t>(std::lround(code_of_light(root * root)));
  }
  return table;
}

const CodeTable& code_table() {
  static const CodeTable table = make_code_table();
  return table;
}

}  // namespace

double light_of_code(double code, double gamma) {
  return std::pow(code / 255.0, gamma);
}

double code_of_light(double light, double gamma) {
  return 255.0 * std::pow(std::clamp(light, 0.0, 1.0), 1.0 / gamma);
}

cv::Mat to_light(const cv::Mat& codes) {
  cv::Mat light;
  add_light(codes, 1.0f, light);
  return light;
}

cv::Mat to_codes(const cv::Mat& light) {
  const CodeTable& table = code_table();
  cv::Mat codes(light.size(), CV_8UC3);
  for (int y = 0; y < light.rows; ++y) {
    const auto* from = light.ptr<float>(y);
    auto* to = codes.ptr<std::uint8_t>(y);
    for (int x = 0; x < 3 * light.cols; ++x) {
      const float root = std::sqrt(std::clamp(from[x], 0.0f, 1.0f));
      to[x] = table[static_cast<std::size_t>(root * kRoots + 0.5f)];
    }
  }
  return codes;
}

void add_light(const cv::Mat& codes, float share, cv::Mat& sum) {
  if (sum.empty()) sum = cv::Mat::zeros(codes.size(), CV_32FC3);
  LightTable table = light_table();
  for (float& light : table) light *= share;
  for (int y = 0; y < codes.rows; ++y) {
    const auto* from = codes.ptr<std::uint8_t>(y);
    auto* to = sum.ptr<float>(y);
    for (int x = 0; x < 3 * codes.cols; ++x) to[x] += table[from[x]];
  }
}

}  // namespace vinebench::sim
