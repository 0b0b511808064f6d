// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/effect_list.h"

#include "sim/sensors/effects/glare.h"

namespace vinebench::sim {

EffectChain make_effects(const EffectsConfig& config, const EffectInputs& inputs) {
  EffectChain effects;
  // Each drawn view. Blur, readout and the lens' distortion follow: they say which views are drawn.
  effects.add(make_glare(inputs));
  // The light on the sensor.
  effects.add(make_lens_dirt(config.dirt, inputs));
  effects.add(make_lens_leaves(config.leaves, inputs));
  effects.add(make_vignetting(config.vignetting, inputs));
  effects.add(make_fixed_pattern(config.fixed_pattern, config.noise.full_well, inputs));
  // The codes that it reads.
  effects.add(make_colour_filters(config.bayer));
  effects.add(make_photon_transfer(config.noise, config.gamma, inputs));
  effects.add(make_colour_interpolation(config.bayer));
  // What the camera makes of them.
  effects.add(make_white_balance(config.white_balance, config.gamma));
  effects.add(make_response(config.response, config.gamma));
  effects.add(make_jpeg(config.jpeg));
  return effects;
}

}  // namespace vinebench::sim
