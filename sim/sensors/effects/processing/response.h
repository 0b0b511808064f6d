// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>

#include "core/config/config_field.h"
#include "sim/sensors/effects/effect.h"

namespace vinebench::sim {

/// What a consumer camera makes of its sensor's colours: a matrix on the linear signal and a curve
/// on the encoded one.
struct ResponseConfig {
  /// Row by row, from the sensor's red, green and blue to the delivered ones. Rows with the sum 1
  /// leave grey as it is.
  std::array<double, 9> matrix{1, 0, 0, 0, 1, 0, 0, 0, 1};
  double saturation = 1;  ///< distance of colours from their grey, after the matrix
  /// S-curve: 0 is none, 1 is 3 x^2 - 2 x^3 of the encoded signal x, below 0 is flatter.
  double contrast = 0;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("matrix", matrix, Range::between(-4, 4));
    archive("saturation", saturation, Range::between(0, 3));
    archive("contrast", contrast, Range::between(-1, 1));
  }
  bool is_off() const;
  /// The matrix with the saturation; grey by the luminance of ITU-R BT.709.
  std::array<double, 9> colours() const;
  /// The encoded signal, 0 to 1, after the S-curve.
  double curve(double encoded) const;
};

/// `gamma` is the sensor's. Null where off.
std::unique_ptr<CodeEffect> make_response(const ResponseConfig& config, double gamma);

}  // namespace vinebench::sim
