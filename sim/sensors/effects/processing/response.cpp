// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/processing/response.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

constexpr std::array<double, 3> kLuminance{0.2126, 0.7152, 0.0722};
/// Codes by the fourth root of the signal, fine enough in the shadows for a gamma of up to 5.
constexpr int kRoots = 16384;

class Response : public CodeEffect {
 public:
  Response(const ResponseConfig& config, double gamma) : codes_(kRoots + 1) {
    const std::array<double, 9> colours = config.colours();
    std::ranges::transform(colours, colours_.begin(),
                           [](double share) { return static_cast<float>(share); });
    for (std::size_t code = 0; code < signal_.size(); ++code) {
      signal_[code] = static_cast<float>(light_of_code(static_cast<double>(code), gamma));
    }
    for (std::size_t i = 0; i < codes_.size(); ++i) {
      const double root = static_cast<double>(i) / kRoots;
      const double encoded = code_of_light(root * root * root * root, gamma) / 255;
      codes_[i] = static_cast<std::uint8_t>(std::lround(255 * config.curve(encoded)));
    }
  }
  void apply(cv::Mat& codes, const Shot&) override {
    for (int y = 0; y < codes.rows; ++y) {
      auto* row = codes.ptr<cv::Vec3b>(y);
      for (int x = 0; x < codes.cols; ++x) row[x] = delivered(row[x]);
    }
  }

 private:
  cv::Vec3b delivered(const cv::Vec3b& seen) const {
    const std::array<float, 3> from{signal_[seen[0]], signal_[seen[1]], signal_[seen[2]]};
    cv::Vec3b codes;
    for (std::size_t c = 0; c < 3; ++c) {
      const float* row = &colours_[3 * c];
      codes[static_cast<int>(c)] = code(row[0] * from[0] + row[1] * from[1] + row[2] * from[2]);
    }
    return codes;
  }
  std::uint8_t code(float signal) const {
    const float root = std::sqrt(std::sqrt(std::clamp(signal, 0.0f, 1.0f)));
    return codes_[static_cast<std::size_t>(root * kRoots + 0.5f)];
  }

  std::array<float, 9> colours_{};
  std::array<float, 256> signal_{};
  std::vector<std::uint8_t> codes_;
};

}  // namespace

bool ResponseConfig::is_off() const {
  return matrix == ResponseConfig().matrix && saturation == 1 && contrast == 0;
}

std::array<double, 9> ResponseConfig::colours() const {
  std::array<double, 9> product{};
  for (std::size_t column = 0; column < 3; ++column) {
    double grey = 0;
    for (std::size_t c = 0; c < 3; ++c) grey += kLuminance[c] * matrix[3 * c + column];
    for (std::size_t c = 0; c < 3; ++c) {
      const double colour = matrix[3 * c + column];
      product[3 * c + column] = grey + saturation * (colour - grey);
    }
  }
  return product;
}

/// Climbs everywhere: its slope is at least 1 - contrast at the ends, 1 + contrast / 2 between.
double ResponseConfig::curve(double encoded) const {
  return encoded + contrast * encoded * (1 - encoded) * (2 * encoded - 1);
}

std::unique_ptr<CodeEffect> make_response(const ResponseConfig& config, double gamma) {
  if (config.is_off()) return nullptr;
  return std::make_unique<Response>(config, gamma);
}

}  // namespace vinebench::sim
