// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/photon_transfer.h"

#include <cmath>
#include <string>

#include "core/util/error.h"
#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

constexpr int kClasses = 256;
constexpr int kDrawsPerHash = 8;  // of 8 bits each

/// Inverse of the standard normal's distribution function: bisection on erfc, exact to 1e-12.
double normal_quantile(double p) {
  double low = -10;
  double high = 10;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Normal draws of that many equally likely classes, ascending, scaled to a variance of one.
std::array<double, kClasses> make_normal_classes() {
  std::array<double, kClasses> classes{};
  double sum_of_squares = 0;
  for (std::size_t i = 0; i < kClasses; ++i) {
    classes[i] = normal_quantile((static_cast<double>(i) + 0.5) / kClasses);
    sum_of_squares += classes[i] * classes[i];
  }
  for (double& z : classes) z *= std::sqrt(kClasses / sum_of_squares);
  return classes;
}

const std::array<double, kClasses>& normal_classes() {
  static const std::array<double, kClasses> classes = make_normal_classes();
  return classes;
}

class PhotonTransferEffect : public CodeEffect {
 public:
  PhotonTransferEffect(const PhotonTransfer& transfer, const PhotonTransferConfig& config,
                       const EffectInputs& inputs)
      : transfer_(transfer),
        seed_(inputs.seed),
        stream_("sensor.noise." + std::to_string(inputs.index)) {
    if (config.pattern) stream_ += ".pattern." + std::to_string(*config.pattern);
  }
  void apply(cv::Mat& codes, const Shot& shot) override {
    transfer_.set_gain(shot.exposure.gain_db);
    transfer_.apply(codes, RandomStream(seed_, stream_, static_cast<std::uint64_t>(shot.frame)));
  }

 private:
  PhotonTransfer transfer_;
  std::uint64_t seed_;
  std::string stream_;
};

}  // namespace

PhotonTransfer::PhotonTransfer(const PhotonTransferConfig& config, double gamma)
    : config_(config), gamma_(gamma) {
  for (std::size_t code = 0; code < borders_.size(); ++code) {
    borders_[code] = light_of_code(static_cast<double>(code) + 0.5, gamma);
  }
  make_table();
}

bool PhotonTransfer::is_identity() const {
  return !config_.enabled && gamma_ == kImageGamma;
}

void PhotonTransfer::set_gain(double gain_db) {
  const int tenths = static_cast<int>(std::lround(10 * gain_db));
  if (tenths == gain_tenths_db_) return;
  gain_tenths_db_ = tenths;
  make_table();
}

void PhotonTransfer::make_table() {
  for (std::size_t level = 0; level < 256; ++level) fill_level(level);
}

/// Draws ascend, so that the code only climbs.
void PhotonTransfer::fill_level(std::size_t level) {
  const double light = light_of_code(static_cast<double>(level));
  const double white = config_.full_well / std::pow(10.0, gain_tenths_db_ / 200.0);
  const double variance = light * white + config_.read_noise * config_.read_noise;
  const double sigma = config_.enabled ? std::sqrt(variance) / white : 0;
  std::size_t code = 0;
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    const double seen = light + sigma * normal_classes()[draw];
    while (code < borders_.size() && seen >= borders_[code]) ++code;
    table_[level * kDraws + draw] = static_cast<std::uint8_t>(code);
  }
}

void PhotonTransfer::apply(cv::Mat& image, const RandomStream& stream) const {
  if (image.depth() != CV_8U) fail("photon transfer: expected an image of 8 bits");
  const int values = image.cols * image.channels();
  const int hashes_per_row = (values + kDrawsPerHash - 1) / kDrawsPerHash;
  const std::uint8_t* table = table_.data();
  for (int y = 0; y < image.rows; ++y) {
    auto* row = image.ptr<std::uint8_t>(y);
    std::uint64_t index =
        static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(hashes_per_row);
    int x = 0;
    for (; x + kDrawsPerHash <= values; x += kDrawsPerHash) {
      const std::uint64_t bits = stream.bits(index++);
      for (int i = 0; i < kDrawsPerHash; ++i) {
        row[x + i] = table[row[x + i] * kDraws + ((bits >> (8 * i)) & 255)];
      }
    }
    for (std::uint64_t bits = stream.bits(index); x < values; ++x, bits >>= 8) {
      row[x] = table[row[x] * kDraws + (bits & 255)];
    }
  }
}

std::unique_ptr<CodeEffect> make_photon_transfer(const PhotonTransferConfig& config, double gamma,
                                                 const EffectInputs& inputs) {
  const PhotonTransfer transfer(config, gamma);
  if (transfer.is_identity()) return nullptr;
  return std::make_unique<PhotonTransferEffect>(transfer, config, inputs);
}

}  // namespace vinebench::sim
