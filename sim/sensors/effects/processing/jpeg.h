// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "core/config/config_field.h"
#include "sim/sensors/effects/effect.h"

namespace vinebench::sim {

/// Compression of the delivered image.
struct JpegConfig {
  std::optional<int> quality;  ///< of libjpeg's scale; not compressed if absent
  template <class Archive>
  void serialize(Archive& archive) {
    archive("quality", quality, Range::between(1, 100));
  }
};

/// To baseline JPEG with colours at half the resolution (4:2:0), and back. libjpeg-turbo's integer
/// transform gives the same bytes with every processor's vector instructions and without. Null
/// where off.
std::unique_ptr<CodeEffect> make_jpeg(const JpegConfig& config);

}  // namespace vinebench::sim
