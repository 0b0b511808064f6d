// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/config/config_field.h"
#include "sim/sensors/effects/bayer.h"
#include "sim/sensors/effects/effect_chain.h"
#include "sim/sensors/effects/fixed_pattern.h"
#include "sim/sensors/effects/glass/lens_dirt.h"
#include "sim/sensors/effects/glass/lens_leaf.h"
#include "sim/sensors/effects/photon_transfer.h"
#include "sim/sensors/effects/processing/jpeg.h"
#include "sim/sensors/effects/processing/response.h"
#include "sim/sensors/effects/processing/white_balance.h"
#include "sim/sensors/effects/vignette.h"

namespace vinebench::sim {

/// Settings of the effects. Only the noise is on by default.
struct EffectsConfig {
  std::vector<LensDirtConfig> dirt;
  std::vector<LensLeafConfig> leaves;
  VignettingConfig vignetting;
  FixedPatternConfig fixed_pattern;
  BayerPattern bayer = BayerPattern::kNone;  ///< colour filters, by the first two rows
  PhotonTransferConfig noise;
  double gamma = 2.2;  ///< code / 255 = signal^(1 / gamma); 1 is linear
  WhiteBalanceConfig white_balance;
  ResponseConfig response;
  JpegConfig jpeg;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("dirt", dirt);
    archive("leaves", leaves);
    archive("vignetting", vignetting);
    archive("fixed_pattern", fixed_pattern);
    archive("bayer", bayer);
    archive("noise", noise);
    archive("gamma", gamma, Range::between(0.2, 5));
    archive("white_balance", white_balance);
    archive("response", response);
    archive("jpeg", jpeg);
  }
};

/// Every effect of one camera, in the order in which light meets them.
EffectChain make_effects(const EffectsConfig& config, const EffectInputs& inputs);

}  // namespace vinebench::sim
