// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/effect_chain.h"

#include <algorithm>
#include <utility>

#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

template <class Effect>
void append(std::unique_ptr<Effect> effect, std::vector<std::unique_ptr<Effect>>& effects) {
  if (effect) effects.push_back(std::move(effect));
}

}  // namespace

void EffectChain::add(std::unique_ptr<ViewEffect> effect) {
  append(std::move(effect), view_effects_);
}

void EffectChain::add(std::unique_ptr<LightEffect> effect) {
  append(std::move(effect), light_effects_);
}

void EffectChain::add(std::unique_ptr<CodeEffect> effect) {
  append(std::move(effect), code_effects_);
}

bool EffectChain::wants_labels(const DrawnView& view) const {
  return std::ranges::any_of(view_effects_,
                             [&](const auto& effect) { return effect->wants_labels(view); });
}

void EffectChain::apply_to_view(RenderedImage& image, const DrawnView& view) const {
  for (const auto& effect : view_effects_) effect->apply(image, view);
}

void EffectChain::develop(cv::Mat& image, const Shot& shot) {
  if (image.depth() == CV_8U && changes_light(shot.instant)) image = to_light(image);
  if (image.depth() == CV_32F) {
    for (const auto& effect : light_effects_) {
      if (effect->is_active(shot.instant)) effect->apply(image, shot);
    }
    image = to_codes(image);
  }
  for (const auto& effect : code_effects_) effect->apply(image, shot);
}

bool EffectChain::changes_light(Stamp instant) const {
  return std::ranges::any_of(light_effects_,
                             [&](const auto& effect) { return effect->is_active(instant); });
}

}  // namespace vinebench::sim
