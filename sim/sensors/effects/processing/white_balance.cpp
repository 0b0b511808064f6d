// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/processing/white_balance.h"

#include <algorithm>
#include <cmath>

#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

using CodeTable = std::array<std::uint8_t, 256>;

CodeTable amplified(double gain, double gamma) {
  CodeTable table{};
  for (std::size_t code = 0; code < table.size(); ++code) {
    const double light = gain * light_of_code(static_cast<double>(code), gamma);
    table[code] = static_cast<std::uint8_t>(std::lround(code_of_light(light, gamma)));
  }
  return table;
}

class WhiteBalance : public CodeEffect {
 public:
  WhiteBalance(const WhiteBalanceConfig& config, double gamma) {
    const std::array<double, 3> gains = config.gains();
    for (std::size_t c = 0; c < tables_.size(); ++c) tables_[c] = amplified(gains[c], gamma);
  }
  void apply(cv::Mat& codes, const Shot&) override {
    for (int y = 0; y < codes.rows; ++y) {
      auto* row = codes.ptr<cv::Vec3b>(y);
      for (int x = 0; x < codes.cols; ++x) {
        for (int c = 0; c < 3; ++c) row[x][c] = tables_[static_cast<std::size_t>(c)][row[x][c]];
      }
    }
  }

 private:
  std::array<CodeTable, 3> tables_{};
};

}  // namespace

std::array<double, 3> WhiteBalanceConfig::gains() const {
  const double smallest = std::min({red, 1.0, blue});
  return {red / smallest, 1 / smallest, blue / smallest};
}

std::unique_ptr<CodeEffect> make_white_balance(const WhiteBalanceConfig& config, double gamma) {
  if (config.is_off()) return nullptr;
  return std::make_unique<WhiteBalance>(config, gamma);
}

}  // namespace vinebench::sim
