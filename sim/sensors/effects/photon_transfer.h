// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/config/config_field.h"
#include "core/util/random.h"
#include "sim/sensors/effects/effect.h"

namespace vinebench::sim {

/// Shot and read noise. The defaults are those of a pixel of about 3 um and give 1.5 grey levels at
/// mid grey.
struct PhotonTransferConfig {
  bool enabled = true;                    ///< whether there is noise
  double full_well = 6900;                ///< electrons that make white at a gain of 0 dB
  double read_noise = 2.5;                ///< electrons, standard deviation
  std::optional<std::int64_t> pattern{};  ///< another number, another noise of the same kind
  template <class Archive>
  void serialize(Archive& archive) {
    archive("enabled", enabled);
    archive("full_well", full_well, Range::between(10, 1e7));
    archive("read_noise", read_noise, Range::between(0, 1e5));
    archive("pattern", pattern, Range::non_negative());
  }
};

/// From the light of a rendered image to the codes that a sensor gives. A pixel of light L (1 is
/// white) at gain G is L * full_well / G electrons; their variance is their number plus read_noise
/// squared (Janesick, Photon Transfer, 2007). The sum is scaled back, saturated, encoded with the
/// sensor's gamma and rounded to 8 bits.
class PhotonTransfer {
 public:
  /// `gamma` is the sensor's: 2.2 encodes as the renderer does, 1 is linear.
  PhotonTransfer(const PhotonTransferConfig& config, double gamma);

  /// Whether it leaves every image as it is.
  bool is_identity() const;

  /// Rounded to a tenth of a dB, so that a slowly turning gain needs few new tables.
  void set_gain(double gain_db);

  /// Turns an image of the renderer's codes, CV_8U of any channels, into the sensor's, in place. A
  /// pixel's draw is a function of the stream and its index alone. Draws end at 2.9 standard
  /// deviations (256 equally likely classes).
  void apply(cv::Mat& image, const RandomStream& stream) const;

 private:
  static constexpr std::size_t kDraws = 256;
  void make_table();
  void fill_level(std::size_t level);

  PhotonTransferConfig config_;
  double gamma_;
  int gain_tenths_db_ = 0;
  std::array<double, 255> borders_{};  ///< light between each code and the next
  /// The sensor's code by the renderer's code and the draw's class.
  std::array<std::uint8_t, 256 * kDraws> table_{};
};

/// The noise of each image and the sensor's encoding. Null where both leave every image as it is.
std::unique_ptr<CodeEffect> make_photon_transfer(const PhotonTransferConfig& config, double gamma,
                                                 const EffectInputs& inputs);

}  // namespace vinebench::sim
